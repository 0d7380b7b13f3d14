#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/base/settings.h"

namespace tubesight::drivers {

/// The shortest decimal that reads back as the same number, with a point: TOML's floats.
[[nodiscard]] std::string plain_number(double value);
/// `[1.5, 2.0]`
[[nodiscard]] std::string plain_numbers(std::span<const double> values);
/// A text in quotation marks.
[[nodiscard]] std::string toml_text(std::string_view text);
/// A comment of one line, with its line feed.
[[nodiscard]] std::string toml_comment(std::string_view text);
/// `[[row, column], ...]`
[[nodiscard]] std::string plain_addresses(std::span<const core::TubeAddress> addresses);

/// `[start]` with the clicks given.
[[nodiscard]] std::string start_text(const core::StartSettings& start);

/// The tables of a session but `[start]`: what reading them gives is `settings` to the last bit.
[[nodiscard]] std::string session_text(const core::SessionSettings& settings);

}  // namespace tubesight::drivers
