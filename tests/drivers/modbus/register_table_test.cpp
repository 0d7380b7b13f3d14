#include "drivers/modbus/register_table.h"

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/names.h"
#include "drivers/modbus/register_codes.h"

namespace tubesight::drivers {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> document() {
  std::ifstream file(TUBESIGHT_SOURCE_DIR "/docs/robot-link.md");
  std::stringstream text;
  text << file.rdbuf();
  return lines_of(text.str());
}

/// The rows of the tables below a heading that begins so, up to the next heading.
std::set<std::string> rows_below(const std::vector<std::string>& lines, const std::string& heading,
                                 const std::regex& row) {
  std::set<std::string> rows;
  bool below = false;
  for (const std::string& line : lines) {
    if (line.starts_with("#")) {
      below = line.starts_with(heading);
    } else if (below && std::regex_search(line, row)) {
      rows.insert(line);
    }
  }
  return rows;
}

const std::regex kRegisterRow{R"(^\| \d+ \| 4\d{4} \|)"};
const std::regex kCodeRow{R"(^\| \d+ \|)"};

/// The rows of a block as the document must have them.
std::set<std::string> rows_of(const RegisterBlock& block) {
  std::set<std::string> rows;
  for (const RegisterRow& row : register_table()) {
    if (block.holds(row.address, 1)) {
      std::string unit(row.unit);
      if (row.per_unit != 1) {
        unit = "1/" + std::to_string(row.per_unit) + (unit.empty() ? "" : " " + unit);
      }
      std::string line = "| " + std::to_string(row.address);
      line += " | " + std::to_string(40001 + row.address) + " | " + std::to_string(row.width);
      line += " | `" + std::string(row.label) + "` | " + unit + " | " + std::string(row.meaning);
      rows.insert(line + " |");
    }
  }
  return rows;
}

std::string heading_of(const RegisterBlock& block) {
  return "### Block `" + std::string(block.label) + "`: " + std::to_string(block.first) + " to " +
         std::to_string(block.last) + (block.writable ? ", read and write" : ", read");
}

TEST(RegisterTable, IsWhatTheDocumentSays) {
  const auto lines = document();
  std::size_t rows = 0;

  for (const RegisterBlock& block : register_blocks()) {
    const auto told = rows_below(lines, heading_of(block), kRegisterRow);
    EXPECT_EQ(told, rows_of(block)) << heading_of(block);
    rows += told.size();
  }

  EXPECT_EQ(rows, rows_below(lines, "### Block", kRegisterRow).size()) << "a block too many";
  EXPECT_EQ(rows, register_table().size());
}

TEST(RegisterTable, ADamagedDocumentIsFound) {
  auto lines = document();
  for (std::string& line : lines) {
    if (line.starts_with("| 126 |")) {
      line.replace(2, 3, "127");
    }
  }
  const RegisterBlock& block = register_blocks()[1];

  EXPECT_NE(rows_below(lines, heading_of(block), kRegisterRow), rows_of(block));
}

TEST(RegisterTable, BlocksAreOfAtMost100Words) {
  for (const RegisterBlock& block : register_blocks()) {
    EXPECT_LE(block.last - block.first + 1, 100) << block.label;
  }
}

/// Codes with their words, from a table `| code | `word` | ... |`.
std::map<std::int32_t, std::string> codes_below(const std::string& heading) {
  std::map<std::int32_t, std::string> codes;
  const std::regex row(R"(^\| (\d+) \| `?([a-z-]*)`? ?\|)");
  for (const std::string& line : rows_below(document(), heading, kCodeRow)) {
    std::smatch match;
    if (std::regex_search(line, match, row)) {
      codes[std::stoi(match[1])] = match[2];
    }
  }
  return codes;
}

template <core::HasWords E>
std::map<std::int32_t, std::string> codes_of() {
  std::map<std::int32_t, std::string> codes;
  for (std::int32_t code = 0; code < core::count_of<E>(); ++code) {
    codes[code] = core::name_of(static_cast<E>(code));
  }
  return codes;
}

TEST(RegisterCodes, AreWhatTheDocumentSays) {
  auto doubts = codes_of<core::ClaimDoubt>();
  doubts[kNoAnswerInTime] = "no-answer";
  auto refusals = codes_of<core::StartRefusal>();
  refusals[kOtherWindow] = "other-window";
  refusals[kNotServed] = "not-served";
  auto picks = codes_of<core::PickDoubt>();
  picks[kNotServed] = "not-served";
  auto poses = codes_of<core::PoseReason>();
  poses[kNotServed] = "not-served";
  std::map<std::int32_t, std::string> states;
  for (const auto state : {core::TrackState::kWaiting, core::TrackState::kTracking,
                           core::TrackState::kDegraded, core::TrackState::kLost}) {
    states[code_of(state)] = core::name_of(state);
  }

  EXPECT_EQ(codes_below("### Codes of `reason`"), codes_of<core::Reason>());
  EXPECT_EQ(codes_below("### Codes of `verdict_reason`"), doubts);
  EXPECT_EQ(codes_below("### Codes of `start_reason`"), refusals);
  EXPECT_EQ(codes_below("### Codes of `pick_reason`"), picks);
  EXPECT_EQ(codes_below("### Codes of `pose_reason`"), poses);
  EXPECT_EQ(codes_below("### Codes of `state`"), states);
}

}  // namespace
}  // namespace tubesight::drivers
