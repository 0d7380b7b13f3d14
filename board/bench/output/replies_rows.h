#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/reply.h"

namespace tubesight::board {

/// First line of a `--replies` file, without the line feed.
inline constexpr std::string_view kRepliesHeader =
    "field,time_s,kind,id,origin,verdict,row,column,claimed_row,claimed_column,judged_field,reason";

/// Appends the row of one answer of the box with its line feed: to a claim, a start, a pick, a pose
/// request or a pose; nothing for others. `field` is the number of the field after which it was
/// said. Cells without meaning stay empty; docs/file-formats.md has the words.
void append_reply_row(std::string& out, std::int64_t field, const core::Reply& reply);

}  // namespace tubesight::board
