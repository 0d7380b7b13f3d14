#include "board/visionbox/page_body.h"

#include <charconv>
#include <cmath>

namespace tubesight::board {
namespace {

constexpr std::int32_t kMostAddress = 100'000;

}  // namespace

std::optional<std::int64_t> whole_of(const Json& body, const char* key, std::int64_t least,
                                     std::int64_t most) {
  const auto found = body.find(key);
  if (found == body.end() || !found->is_number_integer()) {
    return {};
  }
  if (found->is_number_unsigned() && found->get<std::uint64_t>() > INT64_MAX) {
    return {};
  }
  const std::int64_t value = found->get<std::int64_t>();
  return value < least || value > most ? std::nullopt : std::optional(value);
}

std::optional<double> px_of(const Json& body, const char* key) {
  constexpr double kMost = 100'000.0;
  const auto found = body.find(key);
  if (found == body.end() || !found->is_number()) {
    return {};
  }
  const double value = found->get<double>();
  return std::abs(value) <= kMost ? std::optional(value) : std::nullopt;
}

bool flag_of(const Json& body, const char* key) {
  const auto found = body.find(key);
  return found != body.end() && found->is_boolean() && found->get<bool>();
}

std::string text_of(const Json& body, const char* key) {
  const auto found = body.find(key);
  return found != body.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::optional<std::int64_t> number_of(std::string_view text) {
  std::int64_t value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  return parsed.ec == std::errc() && parsed.ptr == text.data() + text.size() ? std::optional(value)
                                                                             : std::nullopt;
}

std::string argument_of(const drivers::PageRequest& request, const std::string& key) {
  const auto found = request.query.find(key);
  return found == request.query.end() ? std::string() : found->second;
}

bool read_tubes(const Json& body, core::Start& start) {
  const auto tubes = body.find("tubes");
  if (tubes == body.end() || !tubes->is_array() || tubes->empty()) {
    return false;
  }
  for (const Json& each : *tubes) {
    if (!each.is_object()) {
      return false;
    }
    const auto row = whole_of(each, "row", -kMostAddress, kMostAddress);
    const auto column = whole_of(each, "column", -kMostAddress, kMostAddress);
    const auto u = px_of(each, "u");
    const auto v = px_of(each, "v");
    if (!row || !column || !u || !v ||
        !start.tubes.try_push_back(
            {{static_cast<std::int32_t>(*row), static_cast<std::int32_t>(*column)}, {*u, *v}})) {
      return false;
    }
  }
  return true;
}

std::optional<std::int64_t> field_of(const Json& body) {
  return whole_of(body, "field", 0, INT64_MAX);
}

}  // namespace tubesight::board
