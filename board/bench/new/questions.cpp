#include "board/bench/new/questions.h"

#include <istream>
#include <ostream>

namespace tubesight::board {

bool Questions::ask(std::string_view option, std::string_view question, std::string_view usual,
                    const std::function<bool(const std::string&)>& accept, std::string& value) {
  const std::string wanted = "expected " + std::string(question);
  if (!value.empty()) {
    if (accept(value)) {
      return true;
    }
    missing_.push_back(std::string(option) + ": '" + value + "', " + wanted);
    return false;
  }
  while (from_ != nullptr) {
    *to_ << question << (usual.empty() ? "" : " [" + std::string(usual) + "]") << ": "
         << std::flush;
    if (!std::getline(*from_, value)) {
      break;
    }
    if (value.empty()) {
      value = usual;
    }
    if (!value.empty() && accept(value)) {
      return true;
    }
    *to_ << "'" << value << "' will not do.\n";
  }
  value = usual;
  if (from_ == nullptr && !usual.empty()) {
    return true;
  }
  missing_.push_back(std::string(option) + ": missing, " + wanted);
  return false;
}

}  // namespace tubesight::board
