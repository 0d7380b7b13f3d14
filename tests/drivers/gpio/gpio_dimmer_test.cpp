#include "drivers/gpio/gpio_dimmer.h"

#include <cerrno>
#include <chrono>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include "tests/hal/dimmer_contract.h"

namespace tubesight::support {
namespace {

using drivers::GpioDimmer;
using drivers::GpioSettings;

/// What lines did, for as long as a test looks.
struct LineLog {
  std::mutex mutex;
  std::vector<std::uint32_t> lit;
  std::string refusal;  ///< of opening
  int status = 0;       ///< of changes
  bool open = false;

  std::vector<std::uint32_t> all() {
    const std::lock_guard lock(mutex);
    return lit;
  }
  std::size_t changes() { return all().size(); }
  void fail(int with) {
    const std::lock_guard lock(mutex);
    status = with;
  }
};

class FakeLineBank final : public drivers::LineBank {
 public:
  explicit FakeLineBank(LineLog& log) : log_(&log) {}

  core::Result<void> open(const drivers::LineBankSettings&, std::string& message) override {
    message = log_->refusal;
    if (!message.empty()) {
      return core::Unexpected(core::Error::kIo);
    }
    log_->open = true;
    return {};
  }
  void close() override { log_->open = false; }
  int set(std::uint32_t lit) override {
    const std::lock_guard lock(log_->mutex);
    if (log_->status == 0) {
      log_->lit.push_back(lit);
    }
    return log_->status;
  }

 private:
  LineLog* log_;
};

GpioSettings settings_of(std::vector<std::string> lines) {
  GpioSettings settings;
  settings.bank = {"pinctrl", std::move(lines), false};
  settings.priority = 0;
  return settings;
}

class GpioBench {
 public:
  explicit GpioBench(std::vector<std::string> lines)
      : dimmer_(settings_of(std::move(lines)), std::make_unique<FakeLineBank>(log_)) {}
  GpioDimmer& dimmer() { return dimmer_; }
  LineLog& log() { return log_; }

  /// Waits until the line changed so often; false after two seconds.
  bool changes(std::size_t times) {
    for (int i = 0; i < 2000 && log_.changes() < times; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return log_.changes() >= times;
  }

 private:
  LineLog log_;
  GpioDimmer dimmer_;
};

class PulseMaker {
 public:
  hal::Dimmer& dimmer() { return bench_.dimmer(); }

 private:
  GpioBench bench_{{"18"}};
};
class StepMaker {
 public:
  hal::Dimmer& dimmer() { return bench_.dimmer(); }

 private:
  GpioBench bench_{{"18", "23", "24"}};
};

INSTANTIATE_TYPED_TEST_SUITE_P(GpioPulses, DimmerContract, PulseMaker);
INSTANTIATE_TYPED_TEST_SUITE_P(GpioSteps, DimmerContract, StepMaker);

TEST(GpioDimmer, OneLineIsPulsed) {
  GpioBench bench({"18"});
  ASSERT_TRUE(bench.dimmer().start());
  EXPECT_EQ(bench.log().changes(), 0u) << "dark as it was taken";

  ASSERT_TRUE(bench.dimmer().set_level(500));
  ASSERT_TRUE(bench.changes(20));
  bench.dimmer().stop();

  const auto lit = bench.log().all();
  for (std::size_t i = 0; i + 1 < lit.size(); ++i) {
    EXPECT_EQ(lit[i], i % 2 == 0 ? 1u : 0u) << "by turns";
  }
  EXPECT_EQ(lit.back(), 0u) << "and dark in the end";
  EXPECT_FALSE(bench.log().open);
}

TEST(GpioDimmer, FullLightHasNoPauses) {
  GpioBench bench({"18"});
  ASSERT_TRUE(bench.dimmer().start());
  ASSERT_TRUE(bench.dimmer().set_level(1000));
  ASSERT_TRUE(bench.changes(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(20));

  EXPECT_EQ(bench.log().all(), (std::vector<std::uint32_t>{1}));
  bench.dimmer().stop();
  EXPECT_EQ(bench.log().all(), (std::vector<std::uint32_t>{1, 0}));
}

TEST(GpioDimmer, DarkDoesNotWaitForThePulsesThread) {
  GpioBench bench({"18"});
  ASSERT_TRUE(bench.dimmer().start());
  ASSERT_TRUE(bench.dimmer().set_level(1000));
  ASSERT_TRUE(bench.changes(1));

  ASSERT_TRUE(bench.dimmer().set_level(0));

  EXPECT_EQ(bench.log().all()[1], 0u);
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(bench.log().all().back(), 0u) << "and stays";
}

TEST(GpioDimmer, FullLightComesBackFromADarkThatTheThreadNeverSaw) {
  GpioBench bench({"18"});
  ASSERT_TRUE(bench.dimmer().start());
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(bench.dimmer().set_level(1000));
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    const std::size_t before = bench.log().changes();

    ASSERT_TRUE(bench.dimmer().set_level(0));
    ASSERT_TRUE(bench.dimmer().set_level(1000));

    ASSERT_TRUE(bench.changes(before + 2)) << i;
    EXPECT_EQ(bench.log().all().back(), 1u) << i;
  }
}

TEST(GpioDimmer, SeveralLinesAreStepsOfLight) {
  GpioBench bench({"18", "23", "24"});
  ASSERT_TRUE(bench.dimmer().start());
  for (const int level : {0, 166, 167, 499, 500, 834, 1000}) {
    ASSERT_TRUE(bench.dimmer().set_level(level));
  }
  bench.dimmer().stop();

  EXPECT_EQ(bench.log().all(), (std::vector<std::uint32_t>{0, 0, 1, 1, 3, 7, 7, 0}));
}

TEST(GpioDimmer, LinesThatCannotBeHadAreTold) {
  GpioBench bench({"18"});
  bench.log().refusal = "line '18' is used by 'spi0', expected it free";

  const auto started = bench.dimmer().start();

  ASSERT_FALSE(started);
  EXPECT_EQ(started.error(), core::Error::kIo);
  EXPECT_EQ(bench.dimmer().message(),
            "lamp on pinctrl: line '18' is used by 'spi0', expected it free");
  bench.log().refusal.clear();
  EXPECT_TRUE(bench.dimmer().start()) << "when they are free";
}

TEST(GpioDimmer, ARefusedStepIsToldAndTheNextMaySucceed) {
  GpioBench bench({"18", "23"});
  ASSERT_TRUE(bench.dimmer().start());
  ASSERT_TRUE(bench.dimmer().set_level(500));
  bench.log().fail(-ENODEV);

  const auto gone = bench.dimmer().set_level(1000);
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error(), core::Error::kDisconnected);
  EXPECT_EQ(bench.dimmer().level_permille(), 500);

  bench.log().fail(0);
  EXPECT_TRUE(bench.dimmer().set_level(1000));
}

TEST(GpioDimmer, ARefusedPulseIsToldByTheNextLevelAndTriedAgain) {
  GpioBench bench({"18"});
  ASSERT_TRUE(bench.dimmer().start());
  bench.log().fail(-EIO);
  ASSERT_TRUE(bench.dimmer().set_level(1000)) << "it is not known yet";
  bool told = false;
  for (int i = 0; i < 2000 && !told; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const auto set = bench.dimmer().set_level(1000);
    told = !set && set.error() == core::Error::kIo;
  }
  EXPECT_TRUE(told);

  bench.log().fail(0);
  EXPECT_TRUE(bench.changes(1)) << "without being asked";
}

}  // namespace
}  // namespace tubesight::support
