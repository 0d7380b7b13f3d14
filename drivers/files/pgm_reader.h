#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "drivers/files/picture_reader.h"

namespace tubesight::drivers {

/// Reads a binary PGM (`P5`) with 255 as its largest value from memory.
///
/// White space and comments may stand anywhere before the largest value; one white-space byte ends
/// the header. Two forms that the format does not know are read too, as they can be told: a CR LF
/// there counts as one line end, and a comment behind the largest value is passed over when without
/// it the picture fills the file. The picture must fill what follows to the byte: a picture that
/// begins a byte too early is shifted, and nothing else would show it.
///
/// Errors: kInvalidArgument damaged, bytes are missing or left over, kUnsupported another largest
/// value or more than 8192 pixels a side; `message` is one line without the file's name.
[[nodiscard]] core::Result<void> read_pgm(std::string_view bytes, GreyPicture& picture,
                                          std::string& message);

}  // namespace tubesight::drivers
