#include "board/visionbox/panic_dimmer.h"

#include <csignal>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/assert.h"
#include "tests/hal/dimmer_contract.h"
#include "tests/support/fake_dimmer.h"

namespace tubesight::board {
namespace {

struct PanicDimmerMaker {
  hal::Dimmer& dimmer() { return dimmer_; }

  support::FakeDimmer lamp_;
  PanicDimmer dimmer_{lamp_};
};

/// A lamp that tells its levels, as whoever watches a dying program sees them.
class TellingLamp final : public hal::Dimmer {
 public:
  core::Result<void> start() override { return {}; }
  void stop() override {}
  core::Result<void> set_level(std::int32_t permille) override {
    level_ = permille;
    static_cast<void>(
        (permille == 0 ? write(STDERR_FILENO, "[dark]", 6) : write(STDERR_FILENO, "[lit]", 5)) > 0);
    return {};
  }
  [[nodiscard]] std::int32_t level_permille() const override { return level_; }

 private:
  std::int32_t level_ = 0;
};

/// A program that is lit, with hooks.
struct LitProgram {
  TellingLamp lamp;
  PanicDimmer dimmer{lamp};

  LitProgram() {
    install_panic_hooks();
    EXPECT_TRUE(dimmer.start());
    EXPECT_TRUE(dimmer.set_level(700));
  }
};

TEST(PanicDimmerDeathTest, AFailedAssertionMakesTheLampDark) {
  EXPECT_DEATH(
      {
        const LitProgram program;
        TUBESIGHT_ASSERT(1 + 1 == 3);
      },
      "\\[lit\\]\\[dark\\].*panic: 1 \\+ 1 == 3 at .*panic_dimmer_test\\.cpp:[0-9]+: the lamp is "
      "dark");
}

TEST(PanicDimmerDeathTest, AnExceptionOfAnyThreadMakesTheLampDark) {
  EXPECT_EXIT(
      {
        const LitProgram program;
        std::thread([] { throw std::runtime_error("out of paper"); }).join();
      },
      ::testing::KilledBySignal(SIGABRT),
      "\\[lit\\]\\[dark\\].*panic: nobody caught: out of paper: the lamp is dark");
}

TEST(PanicDimmerDeathTest, ADeadlySignalMakesTheLampDarkAndStaysTheDeath) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) {
    EXPECT_EXIT(
        {
          const LitProgram program;
          static_cast<void>(std::raise(signal));
        },
        ::testing::KilledBySignal(signal), "\\[lit\\]\\[dark\\].*panic: SIG[A-Z]+: the lamp");
  }
}

/// Recursion that no compiler turns into a loop.
// NOLINTNEXTLINE(misc-no-recursion)
int overflow(int depth) {
  volatile char page[1024];
  page[0] = static_cast<char>(depth);
  return depth < 0 ? 0 : overflow(depth + 1) + page[0];
}

TEST(PanicDimmerDeathTest, AStackThatOverflowsMakesTheLampDark) {
  EXPECT_EXIT(
      {
        const LitProgram program;
        static_cast<void>(overflow(1) == 7);
      },
      ::testing::KilledBySignal(SIGSEGV), "\\[lit\\]\\[dark\\].*panic: SIGSEGV: the lamp is dark");
  EXPECT_EXIT(
      {
        const LitProgram program;
        std::thread([] {
          use_signal_stack();
          static_cast<void>(overflow(1) == 7);
        }).join();
      },
      ::testing::KilledBySignal(SIGSEGV), "\\[lit\\]\\[dark\\].*panic: SIGSEGV: the lamp is dark");
}

/// Tries to be lit again as soon as it is dark, as a thread may that goes on.
class StubbornLamp final : public hal::Dimmer {
 public:
  core::Result<void> start() override { return {}; }
  void stop() override {}
  core::Result<void> set_level(std::int32_t permille) override {
    if (permille == 0) {
      const bool lit = static_cast<bool>(dimmer_.set_level(500));
      static_cast<void>(
          (lit ? write(STDERR_FILENO, "[lit]", 5) : write(STDERR_FILENO, "[refused]", 9)) > 0);
    }
    return {};
  }
  [[nodiscard]] std::int32_t level_permille() const override { return 0; }
  PanicDimmer& dimmer() { return dimmer_; }

 private:
  PanicDimmer dimmer_{*this};
};

TEST(PanicDimmerDeathTest, NobodyLightsItAgain) {
  EXPECT_EXIT(
      {
        StubbornLamp lamp;
        install_panic_hooks();
        static_cast<void>(lamp.dimmer().start());
        static_cast<void>(std::raise(SIGSEGV));
      },
      ::testing::KilledBySignal(SIGSEGV), "^\\[refused\\]tubesightd: panic: SIGSEGV");
}

TEST(PanicDimmerDeathTest, OneThatWasStoppedIsLeftAlone) {
  EXPECT_EXIT(
      {
        LitProgram program;
        program.dimmer.stop();
        static_cast<void>(std::raise(SIGSEGV));
      },
      ::testing::KilledBySignal(SIGSEGV), "^\\[lit\\]tubesightd: panic: SIGSEGV");
}

}  // namespace
}  // namespace tubesight::board

namespace tubesight::support {
INSTANTIATE_TYPED_TEST_SUITE_P(Panic, DimmerContract, board::PanicDimmerMaker);
}  // namespace tubesight::support
