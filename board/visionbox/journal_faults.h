#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "board/visionbox/box_report.h"
#include "board/visionbox/journal_line.h"

namespace tubesight::board {

/// Tells the journal when the camera or the lamp begins to fail and when that is over, by what the
/// self-test says of them; nothing of the time before it has finished, when devices open.
class JournalFaults {
 public:
  using Add = std::function<void(JournalLine)>;

  explicit JournalFaults(Add add) : add_(std::move(add)) {}

  /// Takes the present state.
  void look(const BoxReport& report);

 private:
  void look(std::string_view part, bool bad, const std::string& words);

  Add add_;
  std::map<std::string, bool, std::less<>> bad_;
};

}  // namespace tubesight::board
