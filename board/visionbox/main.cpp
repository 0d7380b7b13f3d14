// tubesightd: the vision box as a service.

#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <sys/signalfd.h>
#include <unistd.h>

#include "board/box/version.h"
#include "board/visionbox/boot_count.h"
#include "board/visionbox/box_service.h"
#include "board/visionbox/box_settings.h"
#include "board/visionbox/golden_recording.h"
#include "board/visionbox/lamp_device.h"
#include "board/visionbox/log.h"
#include "board/visionbox/panic_dimmer.h"
#include "board/visionbox/program_arguments.h"
#include "board/visionbox/record_settings.h"
#include "board/visionbox/service_manager.h"

namespace tubesight::board {
namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;

/// SIGTERM and SIGINT, those of a terminal that is closed, and others that would end the program
/// with its lamp lit, as a descriptor. Blocked before any thread runs, so that none is hit.
class EndSignals {
 public:
  EndSignals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int end : {SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGALRM}) {
      sigaddset(&signals, end);
    }
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    fd_ = signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
  }
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;
  ~EndSignals() { close(fd_); }
  [[nodiscard]] int fd() const { return fd_; }

 private:
  int fd_ = -1;
};

int run(const BoxSettings& settings) {
  const EndSignals signals;
  Log log;
  if (const std::string why = too_much_memory(settings.record, machine_memory_mb()); !why.empty()) {
    log.say(why);
    return kWrongInput;
  }
  const ServiceEnvironment environment = service_environment();
  const auto service = std::make_unique<BoxService>(
      settings,
      BoxService::Found{environment, count_boot(environment.state_folder), run_golden_recording()},
      log);
  if (!service->start()) {
    return kFailed;
  }
  service->serve(signals.fd());
  service->stop();
  return kDone;
}

/// What a service manager calls when the box has died: the lamp is left in no state that a dead
/// program chose.
int darken(const BoxSettings& settings) {
  const auto lamp = make_lamp(settings.lamp);
  const std::string why = lamp == nullptr ? std::string() : make_dark(*lamp);
  if (!why.empty()) {
    Log().say(why);
  }
  return why.empty() ? kDone : kFailed;
}

int run_program(int argc, const char* const* argv) {
  CLI::App app("Tubesight's vision box as a service", "tubesightd");
  app.set_version_flag("--version", version_text("tubesightd"),
                       "Print version, commit and arithmetic, and exit");
  std::string path;
  bool check = false;
  bool dark = false;
  app.add_option("BOX.toml", path, "Settings of the box: source, control, link, session (TOML)")
      ->required();
  app.add_flag("--check", check, "Read the settings, tell every mistake, and exit");
  app.add_flag("--dark", dark, "Make the lamp dark, as after a box that was killed, and exit");
  if (const auto status = read_arguments(app, argc, argv)) {
    return *status;
  }
  const auto settings = std::make_unique<BoxSettings>();
  drivers::Messages messages;
  const bool good = static_cast<bool>(load_box_settings(path, *settings, messages));
  const char* const level = stderr_is_journal() ? "<3>" : "";
  for (const std::string& message : messages) {
    std::fprintf(stderr, "%s%s\n", level, message.c_str());
  }
  if (!good) {
    // A mistake elsewhere is no reason to leave a lamp lit.
    if (dark && settings->lamp_sound) {
      static_cast<void>(darken(*settings));
    }
    return kWrongInput;
  }
  if (check) {
    return kDone;
  }
  return dark ? darken(*settings) : run(*settings);
}

}  // namespace
}  // namespace tubesight::board

int main(int argc, char** argv) {
  // A client that goes away, and a file that may grow no more, are told as a failed write, not by
  // the end of the program.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  tubesight::board::install_panic_hooks();
  try {
    return tubesight::board::run_program(argc, argv);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "tubesightd: stopped: %s\n", problem.what());
    return tubesight::board::kFailed;
  }
}
