#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tubesight::drivers {

/// One JSON object in one line, member after member.
class JsonLine {
 public:
  JsonLine& add(std::string_view key, std::string_view text);
  JsonLine& add(std::string_view key, const char* text) { return add(key, std::string_view(text)); }
  JsonLine& add(std::string_view key, std::int64_t number);
  JsonLine& add(std::string_view key, std::int32_t number) {
    return add(key, static_cast<std::int64_t>(number));
  }
  JsonLine& add(std::string_view key, bool value);
  /// A number that somebody has printed ("12.500"), `null`, or a whole value.
  JsonLine& add_printed(std::string_view key, std::string_view value);

  /// Members up to the matching close() belong to an object under `key`.
  JsonLine& open(std::string_view key);
  JsonLine& close();

  /// The object, complete, without a line feed.
  [[nodiscard]] std::string finish() const { return text_ + '}'; }

 private:
  void name(std::string_view key);

  std::string text_ = "{";
};

/// The text of a JSON string, with its quotes; bytes that are no printable ASCII as escapes, those
/// above it as they are.
[[nodiscard]] std::string json_string(std::string_view text);

/// The value of the first member `key` that is a string, with its escapes resolved (\uXXXX below
/// 128 only); empty where there is none. For a program that reads what JsonLine wrote.
[[nodiscard]] std::string find_json_string(std::string_view line, std::string_view key);

/// The value of the first member `key` that is a whole number; `otherwise` where there is none.
[[nodiscard]] std::int64_t find_json_number(std::string_view line, std::string_view key,
                                            std::int64_t otherwise);

}  // namespace tubesight::drivers
