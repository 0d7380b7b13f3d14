// docs/scenarios.md tells every key with its range and default, every fault and every scenario.

#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "drivers/scenario/scenario_keys.h"
#include "drivers/simulated/fault.h"

namespace tubesight::drivers {
namespace {

const std::string& document() {
  static const std::string text = [] {
    std::ifstream file(std::string(TUBESIGHT_SOURCE_DIR) + "/docs/scenarios.md");
    return std::string(std::istreambuf_iterator<char>(file), {});
  }();
  return text;
}

std::string plain(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

template <typename Struct, std::size_t N>
void expect_told(const std::array<NumberKey<Struct>, N>& keys) {
  const Struct defaults{};
  for (const auto& key : keys) {
    const std::string row = "| `" + std::string(key.key) + "` | " + plain(key.range.least) +
                            " to " + plain(key.range.most) + " | " + plain(defaults.*key.member) +
                            " |";
    EXPECT_NE(document().find(row), std::string::npos) << row;
  }
}

TEST(ScenarioDocument, TellsRangesAndDefaultsOfTheLooks) {
  ASSERT_FALSE(document().empty());
  expect_told(kSheetLookKeys);
  expect_told(kLampLookKeys);
  expect_told(kSensorLookKeys);
  expect_told(kGuidetubeLookKeys);
}

TEST(ScenarioDocument, TellsEveryFault) {
  for (const std::string_view word : drivers::kFaultWords) {
    EXPECT_NE(document().find("| `" + std::string(word) + "` |"), std::string::npos) << word;
  }
}

TEST(ScenarioDocument, ListsTheLibrary) {
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(TUBESIGHT_TEST_DATA_DIR) + "/scenarios")) {
    if (entry.path().extension() == ".toml") {
      const std::string row = "| `" + entry.path().stem().string() + "` |";
      EXPECT_NE(document().find(row), std::string::npos) << row;
    }
  }
}

}  // namespace
}  // namespace tubesight::drivers
