#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace tubesight::board {

/// Asks a person what options did not tell, one line an answer.
///
/// Where nobody can be asked, what is missing is collected instead.
class Questions {
 public:
  /// Asks on `to` and reads from `from`; null `from`: nobody is there.
  Questions(std::istream* from, std::ostream& to) : from_(from), to_(&to) {}

  /// Takes `value` where it is not empty, else asks for it, again until `accept` says that it will
  /// do. An empty answer stands for `usual` where that is not empty. `option` is what would have
  /// told it, `question` what it is with unit and range. False: a value given that will not do (it
  /// is asked for again where somebody is there), the end of the answers, or nobody to ask.
  bool ask(std::string_view option, std::string_view question, std::string_view usual,
           const std::function<bool(const std::string&)>& accept, std::string& value);

  /// Adds a line to what would not do.
  void refuse(const std::string& line) { missing_.push_back(line); }

  /// What was missing or would not do, a line each.
  [[nodiscard]] const std::vector<std::string>& missing() const { return missing_; }

 private:
  std::istream* from_;
  std::ostream* to_;
  std::vector<std::string> missing_;
};

}  // namespace tubesight::board
