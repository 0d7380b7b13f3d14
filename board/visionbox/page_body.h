#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "board/visionbox/page_json.h"
#include "core/base/event.h"
#include "drivers/web/page_server.h"

namespace tubesight::board {

// What stands in a question of the page, which anybody may have written; empty, or false: not that.

[[nodiscard]] std::optional<std::int64_t> whole_of(const Json& body, const char* key,
                                                   std::int64_t least, std::int64_t most);
/// A place in the picture; whether it lies in it is the session's business.
[[nodiscard]] std::optional<double> px_of(const Json& body, const char* key);
[[nodiscard]] bool flag_of(const Json& body, const char* key);
[[nodiscard]] std::string text_of(const Json& body, const char* key);
/// Number of the field that was seen.
[[nodiscard]] std::optional<std::int64_t> field_of(const Json& body);
/// The clicks of a start.
[[nodiscard]] bool read_tubes(const Json& body, core::Start& start);
[[nodiscard]] std::optional<std::int64_t> number_of(std::string_view text);
/// A value of the query; empty: there is none.
[[nodiscard]] std::string argument_of(const drivers::PageRequest& request, const std::string& key);

}  // namespace tubesight::board
