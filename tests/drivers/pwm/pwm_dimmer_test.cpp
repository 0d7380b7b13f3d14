#include "drivers/pwm/pwm_dimmer.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/hal/dimmer_contract.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::support {
namespace {

namespace fs = std::filesystem;
using drivers::PwmDimmer;
using drivers::PwmSettings;

/// A folder that looks like the kernel's, with one chip of two channels, the first exported.
class PwmFolder {
 public:
  PwmFolder() {
    fs::create_directories(folder_.path("devices/fe20c000.pwm"));
    fs::create_directories(folder_.path("class/pwmchip0/pwm0"));
    fs::create_directory_symlink(folder_.path("devices/fe20c000.pwm"),
                                 folder_.path("class/pwmchip0/device"));
    set("npwm", "2\n");
    set("export", "");
    for (const char* file : {"pwm0/duty_cycle", "pwm0/period", "pwm0/enable"}) {
      set(file, "0\n");
    }
    set("pwm0/polarity", "normal\n");
  }

  [[nodiscard]] std::string root() const { return folder_.path("class"); }
  [[nodiscard]] std::string file(const std::string& name) const {
    return folder_.path("class/pwmchip0/" + name);
  }
  void set(const std::string& name, const std::string& text) {
    folder_.write("class/pwmchip0/" + name, text);
  }
  /// What the kernel would read: the first line.
  [[nodiscard]] std::string value(const std::string& name) const {
    std::ifstream read(file(name));
    std::string line;
    std::getline(read, line);
    return line;
  }

 private:
  TemporaryFolder folder_;
};

PwmSettings settings_of(bool inverted = false) { return {"fe20c000.pwm", 0, 1000, inverted}; }

class PwmMaker {
 public:
  hal::Dimmer& dimmer() { return dimmer_; }

 private:
  PwmFolder folder_;
  PwmDimmer dimmer_{settings_of(), folder_.root()};
};

INSTANTIATE_TYPED_TEST_SUITE_P(Pwm, DimmerContract, PwmMaker);

TEST(PwmDimmer, LightIsTheSharePulsesHaveOfTheirPeriod) {
  PwmFolder folder;
  PwmDimmer dimmer(settings_of(), folder.root());
  ASSERT_TRUE(dimmer.start()) << dimmer.message();
  EXPECT_EQ(folder.value("pwm0/period"), "1000000");
  EXPECT_EQ(folder.value("pwm0/duty_cycle"), "0");
  EXPECT_EQ(folder.value("pwm0/enable"), "1");

  ASSERT_TRUE(dimmer.set_level(250));
  EXPECT_EQ(folder.value("pwm0/duty_cycle"), "250000");
  ASSERT_TRUE(dimmer.set_level(1000));
  EXPECT_EQ(folder.value("pwm0/duty_cycle"), "1000000");
  dimmer.stop();
  EXPECT_EQ(folder.value("pwm0/duty_cycle"), "0") << "dark";
}

TEST(PwmDimmer, AnInvertedLampIsDarkWhileTheOutputIsHigh) {
  PwmFolder folder;
  PwmDimmer dimmer(settings_of(true), folder.root());
  ASSERT_TRUE(dimmer.start());
  EXPECT_EQ(folder.value("pwm0/duty_cycle"), "1000000");

  ASSERT_TRUE(dimmer.set_level(250));
  EXPECT_EQ(folder.value("pwm0/duty_cycle"), "750000");
  dimmer.stop();
  EXPECT_EQ(folder.value("pwm0/duty_cycle"), "1000000");
  EXPECT_EQ(folder.value("pwm0/enable"), "1") << "an output that falls would be light";
}

// Somebody left the channel at just our period, but upside down: its dark would be full light.
TEST(PwmDimmer, APolarityThatSomebodyLeftIsSetBack) {
  PwmFolder folder;
  folder.set("pwm0/period", "1000000\n");
  folder.set("pwm0/enable", "1\n");
  folder.set("pwm0/polarity", "inversed\n");
  PwmDimmer dimmer(settings_of(), folder.root());

  ASSERT_TRUE(dimmer.start()) << dimmer.message();

  EXPECT_EQ(folder.value("pwm0/polarity"), "normal");
  EXPECT_EQ(folder.value("pwm0/duty_cycle"), "0");
}

TEST(PwmDimmer, AChipWithoutPolarityIsAsUsual) {
  PwmFolder folder;
  fs::remove(folder.file("pwm0/polarity"));
  PwmDimmer dimmer(settings_of(), folder.root());

  EXPECT_TRUE(dimmer.start()) << dimmer.message();
}

TEST(PwmDimmer, IsFoundByItsNameToo) {
  PwmFolder folder;
  PwmSettings settings = settings_of();
  settings.chip = "pwmchip0";
  PwmDimmer dimmer(settings, folder.root());

  EXPECT_TRUE(dimmer.start());
}

/// The message of a start that fails.
std::string refusal(PwmFolder& folder, const PwmSettings& settings) {
  PwmDimmer dimmer(settings, folder.root());
  const auto started = dimmer.start();
  EXPECT_FALSE(started);
  if (!started) {
    EXPECT_EQ(started.error(), core::Error::kIo);
  }
  EXPECT_FALSE(dimmer.set_level(0)) << "it is not started";
  return dimmer.message();
}

TEST(PwmDimmer, AChipThatIsNotThereNamesThoseThatAre) {
  PwmFolder folder;
  PwmSettings settings = settings_of();
  settings.chip = "pwmchip7";

  EXPECT_EQ(refusal(folder, settings),
            "lamp on pwmchip7 channel 0: there is no such chip, expected one of: fe20c000.pwm");
}

TEST(PwmDimmer, AChannelThatTheChipDoesNotHaveIsRefused) {
  PwmFolder folder;
  PwmSettings settings = settings_of();
  settings.channel = 2;

  EXPECT_EQ(refusal(folder, settings), "lamp on fe20c000.pwm channel 2: the chip has 2 channels");
}

TEST(PwmDimmer, AChannelThatNeverComesIsToldAfterAWhile) {
  PwmFolder folder;
  PwmSettings settings = settings_of();
  settings.channel = 1;

  EXPECT_EQ(refusal(folder, settings),
            "lamp on fe20c000.pwm channel 1: duty_cycle: No such file or directory, expected it "
            "writable by the box's user");
  EXPECT_EQ(folder.value("export"), "1") << "it was asked for";
}

TEST(PwmDimmer, APeriodThatIsNotKeptIsRefused) {
  PwmFolder folder;
  fs::remove(folder.file("pwm0/period"));
  fs::create_symlink("/dev/null", folder.file("pwm0/period"));

  EXPECT_EQ(refusal(folder, settings_of()),
            "lamp on fe20c000.pwm channel 0: period is -1 ns, expected 1000000");
}

TEST(PwmDimmer, APolarityThatStaysIsRefused) {
  PwmFolder folder;
  fs::remove(folder.file("pwm0/polarity"));
  fs::create_symlink("/dev/null", folder.file("pwm0/polarity"));

  EXPECT_EQ(refusal(folder, settings_of()),
            "lamp on fe20c000.pwm channel 0: polarity is not normal, expected it so: dark would be "
            "light");
}

TEST(PwmDimmer, ARefusalOfTheKernelIsToldAndTheNextStartMaySucceed) {
  PwmFolder folder;
  fs::remove(folder.file("pwm0/duty_cycle"));
  fs::create_symlink("/dev/full", folder.file("pwm0/duty_cycle"));

  EXPECT_EQ(refusal(folder, settings_of()),
            "lamp on fe20c000.pwm channel 0: duty_cycle = 0: No space left on device");

  fs::remove(folder.file("pwm0/duty_cycle"));
  folder.set("pwm0/duty_cycle", "0\n");
  PwmDimmer dimmer(settings_of(), folder.root());
  ASSERT_TRUE(dimmer.start());
  EXPECT_TRUE(dimmer.set_level(100));
}

TEST(PwmChips, AreListedWithWhatStays) {
  PwmFolder folder;

  const auto chips = drivers::list_pwm_chips(folder.root());

  ASSERT_EQ(chips.size(), 1u);
  EXPECT_EQ(chips[0].name, "pwmchip0");
  EXPECT_EQ(chips[0].device, "fe20c000.pwm");
  EXPECT_EQ(chips[0].channels, 2);
  EXPECT_TRUE(drivers::list_pwm_chips(folder.root() + "/none").empty());
}

}  // namespace
}  // namespace tubesight::support
