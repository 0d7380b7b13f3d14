// What is written to a channel, in which order, and how bright the lamp is on the way.

#include <algorithm>
#include <cerrno>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/drivers/pwm/pwm_folder.h"

namespace tubesight::support {
namespace {

using drivers::PwmDimmer;

/// The kernel's rules over the folder: what it refuses, and what its output does.
class RuledFiles final : public drivers::PwmFiles {
 public:
  RuledFiles(PwmFolder& folder, bool lamp_shines_low) : folder_(folder), low_(lamp_shines_low) {}

  int write(const std::string& path, const std::string& value) override {
    const std::string name = path.substr(path.rfind('/') + 1);
    // Nothing is applied to a channel that has no period yet, not even a pulse of 0.
    if (number("period") == 0 && name != "period") {
      return -EINVAL;
    }
    if (name == "duty_cycle" && std::stoll(value) > number("period")) {
      return -EINVAL;
    }
    if (name == "period" && std::stoll(value) < std::max<std::int64_t>(number("duty_cycle"), 1)) {
      return -EINVAL;
    }
    if (name == "polarity" && number("enable") == 1) {
      return -EBUSY;
    }
    folder_.set("pwm0/" + name, value + "\n");
    written_.push_back(name + " " + value);
    brightest_permille_ = std::max(brightest_permille_, light_permille());
    return 0;
  }
  std::string read(const std::string& path) override {
    return drivers::system_pwm_files().read(path);
  }

  [[nodiscard]] const std::vector<std::string>& written() const { return written_; }
  /// Of all states that were written while the channel was enabled.
  [[nodiscard]] std::int64_t brightest_permille() const { return brightest_permille_; }

 private:
  [[nodiscard]] std::int64_t number(const std::string& name) const {
    return std::stoll(folder_.value("pwm0/" + name));
  }
  [[nodiscard]] std::int64_t light_permille() const {
    if (number("enable") != 1) {
      return 0;  // what rests is looked at by its own test
    }
    const std::int64_t pulse = 1000 * number("duty_cycle") / number("period");
    const bool high = folder_.value("pwm0/polarity") == "normal";
    return high != low_ ? pulse : 1000 - pulse;
  }

  PwmFolder& folder_;
  bool low_;
  std::vector<std::string> written_;
  std::int64_t brightest_permille_ = 0;
};

class PwmOrder : public testing::TestWithParam<bool> {
 protected:
  void left(const std::string& period, const std::string& duty, const std::string& polarity) {
    folder_.set("pwm0/period", period + "\n");
    folder_.set("pwm0/duty_cycle", duty + "\n");
    folder_.set("pwm0/polarity", polarity + "\n");
    folder_.set("pwm0/enable", "1\n");
  }
  void start() {
    ASSERT_TRUE(dimmer_.start()) << dimmer_.message();
    EXPECT_EQ(folder_.value("pwm0/enable"), "1");
    EXPECT_EQ(folder_.value("pwm0/polarity"), "normal");
    EXPECT_EQ(folder_.value("pwm0/period"), "1000000");
    EXPECT_EQ(folder_.value("pwm0/duty_cycle"), inverted() ? "1000000" : "0");
  }
  [[nodiscard]] int times(const std::string& write) const {
    return static_cast<int>(std::ranges::count(files_.written(), write));
  }
  static bool inverted() { return GetParam(); }

  PwmFolder folder_;
  RuledFiles files_{folder_, inverted()};
  PwmDimmer dimmer_{pwm_settings(inverted()), folder_.root(), files_};
};
INSTANTIATE_TEST_SUITE_P(Lamp, PwmOrder, testing::Bool(),
                         [](const auto& which) { return which.param ? "Inverted" : "Usual"; });

// An output that was never enabled is low: where the lamp shines then, enabling it ends that.
TEST_P(PwmOrder, AFreshChannelIsDarkFromItsFirstPulse) {
  start();
  EXPECT_EQ(files_.written().back(), "enable 1");
  EXPECT_EQ(files_.brightest_permille(), 0);
  EXPECT_EQ(times("enable 0"), 0) << "it rests already";
}

TEST_P(PwmOrder, AChannelThatABoxLeftDarkStaysDark) {
  left("1000000", inverted() ? "1000000" : "0", "normal");
  start();
  EXPECT_EQ(files_.brightest_permille(), 0);
  EXPECT_EQ(times("enable 0"), 0) << "an output that falls is full light of an inverted lamp";
}

// At rest an output falls: an inverted lamp would shine in full.
TEST_P(PwmOrder, AnotherPeriodIsTakenWithoutARest) {
  left("250000", inverted() ? "250000" : "0", "normal");
  start();
  EXPECT_EQ(times("enable 0"), 0);
  EXPECT_LT(files_.brightest_permille(), 1000) << "less than full light on the way";
  if (!inverted()) {
    EXPECT_EQ(files_.brightest_permille(), 0);
  }
}

TEST_P(PwmOrder, ALongerPeriodIsTakenWithoutARest) {
  left("4000000", "2000000", "normal");
  start();
  EXPECT_EQ(times("enable 0"), 0);
  EXPECT_LT(files_.brightest_permille(), 1000);
}

TEST_P(PwmOrder, AChannelUpsideDownIsDarkBeforeAndAfterItIsTurned) {
  left("1000000", "500000", "inversed");
  start();
  const auto& written = files_.written();
  const auto rest = std::ranges::find(written, "enable 0");
  ASSERT_NE(rest, written.end()) << "the kernel turns a resting one alone";
  ASSERT_NE(rest, written.begin());
  EXPECT_EQ(*(rest - 1), inverted() ? "duty_cycle 0" : "duty_cycle 1000000") << "dark, as it is";
  EXPECT_EQ(*(rest + 1), "polarity normal");
  EXPECT_EQ(written.back(), "enable 1");
  EXPECT_EQ(*(written.end() - 2), inverted() ? "duty_cycle 1000000" : "duty_cycle 0");
  EXPECT_EQ(files_.brightest_permille(), 0);
}

TEST_P(PwmOrder, AChannelUpsideDownAndOfAnotherPeriodIsTurnedToo) {
  left("4000000", "1000000", "inversed");
  start();
  EXPECT_EQ(files_.brightest_permille(), 0);
}

}  // namespace
}  // namespace tubesight::support
