// What the writer of scenarios writes is what their reader reads: every key there and back.

#include "drivers/scenario/scenario_text.h"

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/scenario/scenario_file.h"
#include "drivers/simulated/fault.h"
#include "tests/drivers/scenario/every_scenario_key.h"
#include "tests/drivers/settings/settings_files.h"
#include "tests/drivers/settings/table_text.h"

namespace tubesight::drivers {
namespace {

using drivers::TextKey;

/// What a file may wish for, which has become something else when it is read: clicks, moves,
/// claims. The manner of `[path]` is that of its steps.
const std::set<std::string> kWishes = {"event.click_on",
                                       "event.off_center",
                                       "path.acceleration_deg_s2",
                                       "path.acceleration_mm_s2",
                                       "path.jerk_deg_s3",
                                       "path.jerk_mm_s3",
                                       "path.offset_mm",
                                       "path.profile",
                                       "path.scatter_mm",
                                       "path.speed_deg_s",
                                       "path.speed_mm_s",
                                       "path.tube",
                                       "start.click_on",
                                       "start.off_center",
                                       "step.claim",
                                       "step.claim_tube",
                                       "step.offset_mm",
                                       "step.to",
                                       "step.tour",
                                       "step.pause_s",
                                       "step.at_most"};

/// Steps and events of which every key is a wish: they are read, but never written.
const std::string kWishful =
    "[[step]]\ntour = [[40, 61], [40, 63]]\n\n[[step]]\nto = [40, 61]\n\n"
    "[[event]]\nkind = \"start\"\nat_s = 2.0\n";

struct Reading {
  std::unique_ptr<ScenarioFile> file = std::make_unique<ScenarioFile>();
  drivers::Messages messages;
  bool good = false;

  explicit Reading(const std::string& text) {
    drivers::MemoryFiles files;
    files.texts["s.toml"] = text;
    good = load_scenario(files, "s.toml", {}, *file, messages).has_value();
  }
  [[nodiscard]] std::string written() const {
    return scenario_text(file->scenario, file->title, &file->expect);
  }
};

TEST(ScenarioText, WritesEveryKeyAsItWasRead) {
  const Reading read(kEveryKey);
  ASSERT_TRUE(read.good) << read.messages.front();

  EXPECT_EQ(read.written(), kEveryKey);
}

TEST(ScenarioText, WritesEveryKeyThatTheReaderKnows) {
  drivers::Messages all;
  for (const std::string& text : drivers::with_an_unknown_key(kEveryKey + kWishful)) {
    const Reading read(text);
    EXPECT_FALSE(read.good);
    all.insert(all.end(), read.messages.begin(), read.messages.end());
  }

  EXPECT_EQ(drivers::surplus_of(all, kEveryKey), kWishes);

  // Within the lists of tables, too.
  const std::size_t tube = kEveryKey.find("{ row = 15");
  const Reading displaced(kEveryKey.substr(0, tube) + "{ unheard_of = 1, " +
                          kEveryKey.substr(tube + 2));
  EXPECT_EQ(drivers::expected_words(displaced.messages.front()),
            (std::vector<std::string>{"row", "column", "by_mm"}));
}

TEST(ScenarioText, WritesEveryTableThatTheReaderKnowsButTheRobot) {
  const Reading read(kEveryKey + "\n[unheard_of]\n");
  ASSERT_FALSE(read.good);

  for (const std::string& table : drivers::expected_words(read.messages.front())) {
    EXPECT_EQ(kEveryKey.find("[" + table + "]") == std::string::npos, table == "robot") << table;
  }
}

TEST(ScenarioText, TestsFaultsOfEveryKind) {
  for (const std::string_view kind : drivers::kFaultWords) {
    EXPECT_NE(kEveryKey.find("kind = \"" + std::string(kind) + "\"\n"), std::string::npos) << kind;
  }
}

// A key whose value is the default could be lost on the way and nobody would see. The keys of a
// session have a test of their own beside its writer.
TEST(ScenarioText, TellsEveryKeyOfTheTestFromItsDefault) {
  std::string plain = kEveryKey.substr(kEveryKey.find("[camera]"));
  plain.resize(plain.find("[motion]"));
  plain += "[path]\nat_mm = [680.5, 768.25]\n[[step]]\nrest_s = 3.0\n";
  for (const char* const move : {"to_mm = [680.5, 780.0]", "heading_deg = 7.0"}) {
    plain += "[[step]]\n" + std::string(move) + "\n";
  }
  for (const std::string_view kind : drivers::kFaultWords) {
    const bool after_another = kind == "other-camera";  // frozen, which ends
    plain += std::string("[[fault]]\nat_s = ") + (after_another ? "1.5" : "0.5") + "\nkind = \"" +
             std::string(kind) + "\"\n";
    const bool steps = kind == "jump" || kind == "other-camera";
    plain += kind == "lamps-dead" ? "lamps = [2]\n" : steps ? "steps = [2, 2]\n" : "";
    const bool lasts =
        kind == "vibration" || kind == "lamp-drift" || kind == "frozen" || kind == "skip";
    plain += lasts ? "for_s = 0.5\n" : "";
  }
  const Reading read(plain);
  ASSERT_TRUE(read.good) << read.messages.front();
  const std::string defaults = read.written();
  std::set<std::string> lines;
  for (const TextKey& key : drivers::keys_of(defaults)) {
    lines.insert(key.table + "." + defaults.substr(key.first, key.size));
  }

  const std::set<std::string> session = {"camera", "tool",  "tubesheet",   "start",
                                         "motion", "edges", "verification"};
  for (const TextKey& key : drivers::keys_of(kEveryKey)) {
    if (key.key != "format" && key.key != "kind" && key.key != "at_mm" &&
        !session.contains(key.table)) {
      const std::string line = key.table + "." + kEveryKey.substr(key.first, key.size);
      EXPECT_FALSE(lines.contains(line)) << line;
    }
  }
}

}  // namespace
}  // namespace tubesight::drivers
