#include "drivers/pwm/pwm_dimmer.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/drivers/pwm/pwm_folder.h"
#include "tests/hal/dimmer_contract.h"

namespace tubesight::support {
namespace {

namespace fs = std::filesystem;
using drivers::PwmDimmer;
using drivers::PwmSettings;

class PwmMaker {
 public:
  hal::Dimmer& dimmer() { return dimmer_; }

 private:
  PwmFolder folder_;
  PwmDimmer dimmer_{pwm_settings(), folder_.root()};
};

INSTANTIATE_TYPED_TEST_SUITE_P(Pwm, DimmerContract, PwmMaker);

TEST(PwmDimmer, LightIsTheSharePulsesHaveOfTheirPeriod) {
  PwmFolder folder;
  PwmDimmer dimmer(pwm_settings(), folder.root());
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
  PwmDimmer dimmer(pwm_settings(true), folder.root());
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
  PwmDimmer dimmer(pwm_settings(), folder.root());

  ASSERT_TRUE(dimmer.start()) << dimmer.message();

  EXPECT_EQ(folder.value("pwm0/polarity"), "normal");
  EXPECT_EQ(folder.value("pwm0/duty_cycle"), "0");
}

TEST(PwmDimmer, AChipWithoutPolarityIsAsUsual) {
  PwmFolder folder;
  fs::remove(folder.file("pwm0/polarity"));
  PwmDimmer dimmer(pwm_settings(), folder.root());

  EXPECT_TRUE(dimmer.start()) << dimmer.message();
}

TEST(PwmDimmer, IsFoundByItsNameToo) {
  PwmFolder folder;
  PwmSettings settings = pwm_settings();
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
  PwmSettings settings = pwm_settings();
  settings.chip = "pwmchip7";

  EXPECT_EQ(refusal(folder, settings),
            "lamp on pwmchip7 channel 0: there is no such chip, expected one of: fe20c000.pwm");
}

TEST(PwmDimmer, AChannelThatTheChipDoesNotHaveIsRefused) {
  PwmFolder folder;
  PwmSettings settings = pwm_settings();
  settings.channel = 2;

  EXPECT_EQ(refusal(folder, settings), "lamp on fe20c000.pwm channel 2: the chip has 2 channels");
}

TEST(PwmDimmer, AChannelThatNeverComesIsToldAfterAWhile) {
  PwmFolder folder;
  PwmSettings settings = pwm_settings();
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

  EXPECT_EQ(refusal(folder, pwm_settings()),
            "lamp on fe20c000.pwm channel 0: period is -1 ns, expected 1000000");
}

TEST(PwmDimmer, APolarityThatStaysIsRefused) {
  PwmFolder folder;
  fs::remove(folder.file("pwm0/polarity"));
  fs::create_symlink("/dev/null", folder.file("pwm0/polarity"));

  EXPECT_EQ(refusal(folder, pwm_settings()),
            "lamp on fe20c000.pwm channel 0: polarity is not normal, expected it so: dark would be "
            "light");
}

// Two boxes, or two lamps of one: the second would undo what the first does.
TEST(PwmDimmer, AChannelThatAnotherHasIsRefusedAndNotTouched) {
  PwmFolder folder;
  PwmDimmer first(pwm_settings(), folder.root());
  ASSERT_TRUE(first.start());
  ASSERT_TRUE(first.set_level(300));
  PwmSettings settings = pwm_settings(true);
  settings.frequency_hz = 5000;

  EXPECT_EQ(
      refusal(folder, settings),
      "lamp on fe20c000.pwm channel 0: is busy: another box or lamp has it, expected it free");
  EXPECT_EQ(folder.value("pwm0/duty_cycle"), "300000");
  EXPECT_EQ(folder.value("pwm0/period"), "1000000");

  first.stop();
  PwmDimmer second(settings, folder.root());
  EXPECT_TRUE(second.start()) << "when it is free: " << second.message();
}

TEST(PwmDimmer, ARefusalOfTheKernelIsToldAndTheNextStartMaySucceed) {
  PwmFolder folder;
  fs::remove(folder.file("pwm0/duty_cycle"));
  fs::create_symlink("/dev/full", folder.file("pwm0/duty_cycle"));

  EXPECT_EQ(refusal(folder, pwm_settings()),
            "lamp on fe20c000.pwm channel 0: duty_cycle = 0: No space left on device");

  fs::remove(folder.file("pwm0/duty_cycle"));
  folder.set("pwm0/duty_cycle", "0\n");
  PwmDimmer dimmer(pwm_settings(), folder.root());
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
