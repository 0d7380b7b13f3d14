// tubesightd: the vision box as a service.

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <sys/signalfd.h>
#include <unistd.h>

#include "board/box/version.h"
#include "board/visionbox/box_settings.h"
#include "board/visionbox/box_watch.h"
#include "board/visionbox/control_desk.h"
#include "board/visionbox/lamp_device.h"
#include "board/visionbox/log.h"
#include "board/visionbox/panic_dimmer.h"
#include "board/visionbox/record_settings.h"
#include "board/visionbox/service_manager.h"
#include "board/visionbox/supervisor.h"
#include "board/visionbox/vision_box.h"
#include "drivers/control/control_server.h"

namespace tubesight::board {
namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongInput = 2;

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

/// Who watches over the box.
struct Watched {
  Supervisor& supervisor;
  ServiceManager& manager;
};

/// Serves until a signal ends it.
void serve(VisionBox& box, ControlDesk& desk, drivers::ControlServer& server, BoxWatch& watch,
           const EndSignals& signals, const Watched& watched) {
  constexpr std::chrono::milliseconds kIdle{100};
  constexpr std::chrono::milliseconds kBusy{4};  // an answer comes with the next field
  bool ended = false;
  std::string told;
  while (!ended) {
    watched.supervisor.beat();
    ended = server.serve(desk.busy() ? kBusy : kIdle, signals.fd());
    desk.serve_replies(server, monotonic_now());
    box.look_after();
    watch.look(box.report());
    if (watch.headline() != told) {
      told = watch.headline();
      watched.manager.say_status(told);
    }
  }
}

int run(const BoxSettings& settings) {
  const EndSignals signals;
  Log log;
  const auto tell = [&log](const std::string& line) { log.say(line); };
  if (const std::string why = too_much_memory(settings.record, machine_memory_mb()); !why.empty()) {
    log.say(why);
    return kWrongInput;
  }
  const auto box = std::make_unique<VisionBox>(settings, tell);
  ServiceManager manager(service_environment(), tell);
  Supervisor supervisor([&box] { return box->beats(); }, settings.watchdog, manager, tell);
  BoxWatch watch(tell);
  const auto report = [&] {
    BoxReport now = box->report();
    now.fields_per_s = watch.fields_per_s();
    now.supervision = supervisor.report();
    return now;
  };
  ControlDesk desk(report, *box, settings.told().start);
  drivers::ControlServer server(desk);
  if (!settings.control_socket.empty() && !server.start(settings.control_socket)) {
    log.say(server.message());
    return kFailed;
  }
  if (!box->start()) {
    log.say("cannot be started");
    return kFailed;
  }
  log.say("started, " + std::string(program_version()));
  supervisor.start();
  manager.say_ready();
  serve(*box, desk, server, watch, signals, {supervisor, manager});
  manager.say_stopping();
  supervisor.begin_to_stop();
  box->stop();
  desk.serve_replies(server, monotonic_now());  // what stop() wrote, somebody may wait for
  server.stop();
  supervisor.stop();
  log.say("stopped");
  return kDone;
}

/// What a service manager calls when the box has died: the lamp is left in no state that a dead
/// program chose.
int darken(const BoxSettings& settings) {
  const auto lamp = make_lamp(settings.lamp);
  const std::string why = lamp == nullptr ? std::string() : make_dark(*lamp);
  if (!why.empty()) {
    std::fprintf(stderr, "tubesightd: %s\n", why.c_str());
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
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      return app.exit(problem) == 0 ? kDone : kWrongInput;
    }
    std::string text = problem.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    std::fprintf(stderr, "tubesightd: %s (tubesightd --help tells the arguments)\n", text.c_str());
    return kWrongInput;
  }
  const auto settings = std::make_unique<BoxSettings>();
  drivers::Messages messages;
  const bool good = static_cast<bool>(load_box_settings(path, *settings, messages));
  for (const std::string& message : messages) {
    std::fprintf(stderr, "%s\n", message.c_str());
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
