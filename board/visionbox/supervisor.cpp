#include "board/visionbox/supervisor.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "board/visionbox/panic_dimmer.h"
#include "board/visionbox/real_time.h"
#include "board/visionbox/wakeup.h"

namespace tubesight::board {
namespace {

constexpr std::chrono::milliseconds kLookEvery{200};
constexpr std::chrono::seconds kOpenEvery{1};
constexpr MonotonicTime kMostBetweenMeals = std::chrono::seconds(1);
/// A lamp's soft end takes 10 s at most; corrections by zones and a recording some more.
constexpr MonotonicTime kLongestStop = std::chrono::seconds(30);

}  // namespace

Supervisor::Supervisor(std::function<Beats()> beats, const WatchdogSettings& settings,
                       ServiceManager& manager, Tell tell, drivers::WatchdogKernel& kernel)
    : beats_(std::move(beats)),
      settings_(settings),
      manager_(&manager),
      tell_(std::move(tell)),
      hardware_(settings.device, kernel) {}

void Supervisor::start() {
  ended_ = false;
  thread_ = std::thread([this] {
    use_signal_stack();
    name_this_thread("supervisor");
    while (!ended_) {
      const MonotonicTime now = monotonic_now();
      look(now);
      sleep_until(now + kLookEvery);
    }
  });
}

void Supervisor::end() {
  ended_ = true;
  if (thread_.joinable()) {
    thread_.join();
  }
}

void Supervisor::begin_to_stop() { stop_by_ns_ = (monotonic_now() + kLongestStop).count(); }

void Supervisor::stop() {
  end();
  hardware_.stop();
  const std::lock_guard lock(mutex_);
  armed_ = false;
}

void Supervisor::look(MonotonicTime now) {
  const MonotonicTime stop_by{stop_by_ns_.load()};
  std::string stuck;
  if (stop_by == MonotonicTime{0}) {
    Beats beats = beats_();
    beats[static_cast<std::size_t>(Part::kDesk)] = desk_;
    signs_.look(beats, now);
    stuck = signs_.stuck();
  } else if (now > stop_by) {
    stuck = "the way to the end";
  }
  if (stuck != told_stuck_) {
    told_stuck_ = stuck;
    tell_(stuck.empty() ? "supervision: every part comes round again, the watchdogs are fed"
                        : "supervision: stands still: " + stuck + "; the watchdogs are not fed");
  }
  {
    const std::lock_guard lock(mutex_);
    stuck_ = stuck;
  }
  if (stuck.empty()) {
    feed_hardware(now);
    feed_manager(now);
  }
}

void Supervisor::feed_hardware(MonotonicTime now) {
  if (!settings_.wanted()) {
    return;
  }
  if (hardware_.timeout().count() > 0) {
    if (!hardware_.feed()) {
      hardware_.stop();
      trouble(hardware_.message());
    }
    return;
  }
  if (now < next_open_) {
    return;
  }
  next_open_ = now + kOpenEvery;
  if (!hardware_.start(std::chrono::seconds(settings_.timeout_s))) {
    trouble(hardware_.message());
    return;
  }
  trouble({});
  tell_("watchdog: " + settings_.device + " (" + hardware_.name() + ") resets the machine " +
        std::to_string(hardware_.timeout().count()) + " s after the box stands still");
  if (!hardware_.note().empty()) {
    tell_("watchdog: " + hardware_.note());
  }
}

/// One that is tried again and again fails in the same way.
void Supervisor::trouble(const std::string& why) {
  bool told = false;
  {
    const std::lock_guard lock(mutex_);
    told = why.empty() || why == trouble_;
    trouble_ = why;
    armed_ = why.empty();
    timeout_s_ = hardware_.timeout().count();
  }
  if (!told) {
    tell_("watchdog: " + why + "; the box goes on without it and tries again");
  }
}

void Supervisor::feed_manager(MonotonicTime now) {
  if (manager_->watchdog().count() == 0 || now < next_manager_) {
    return;
  }
  manager_->feed();
  next_manager_ = now + std::min<MonotonicTime>(manager_->watchdog() / 4, kMostBetweenMeals);
}

SupervisionReport Supervisor::report() const {
  SupervisionReport report;
  report.device = settings_.device;
  report.manager = manager_->there();
  report.manager_ms =
      std::chrono::duration_cast<std::chrono::milliseconds>(manager_->watchdog()).count();
  report.manager_lost = manager_->lost();
  const std::lock_guard lock(mutex_);
  report.armed = armed_;
  report.timeout_s = timeout_s_;
  report.trouble = trouble_;
  report.stuck = stuck_;
  return report;
}

}  // namespace tubesight::board
