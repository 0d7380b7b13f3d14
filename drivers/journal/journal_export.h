#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace tubesight::drivers {

/// How rows are written for other programs.
enum class JournalFormat : std::uint8_t {
  kCsv,        ///< RFC 4180, a header first; what is not known is an empty cell
  kJsonLines,  ///< an object a line, with null for what is not known
};

/// Takes pieces of text; false: it cannot, and the export ends.
using JournalSink = std::function<bool(std::string_view)>;

/// Writes all rows with all columns, `chain` the last. Pictures are not in it.
///
/// Errors: kIo the journal cannot be read, kDataLoss it is none or damaged, `message` saying why;
/// kBufferTooSmall the sink refused, and knows why itself.
[[nodiscard]] core::Result<std::int64_t> export_journal(const std::string& path,
                                                        JournalFormat format,
                                                        const JournalSink& sink,
                                                        std::string& message);

}  // namespace tubesight::drivers
