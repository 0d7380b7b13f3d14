#pragma once

#include <string>

#include "core/base/result.h"

namespace tubesight::drivers {

/// Copies a journal as it is at one instant, while a box may go on writing it: to a USB stick, say.
/// The copy is one file, appears under its name when it is whole, and is on the disk when this
/// returns.
///
/// Errors, after which nothing stands there that was not there before: kInvalidArgument `to` is
/// there already, kIo one of them cannot be read or written, kDataLoss what is to be copied is
/// damaged; `message` says why, in one line.
[[nodiscard]] core::Result<void> copy_journal(const std::string& from, const std::string& to,
                                              std::string& message);

}  // namespace tubesight::drivers
