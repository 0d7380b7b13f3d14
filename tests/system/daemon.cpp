#include "tests/system/daemon.h"

#include <csignal>
#include <cstdlib>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tubesight::tests {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

/// The emulator and its options, the program, its arguments.
std::vector<std::string> command_line(const std::string& program,
                                      const std::vector<std::string>& arguments) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : std::string(TUBESIGHT_EMULATOR) + ' ') {
    if (c != ' ') {
      word += c;
    } else if (!word.empty()) {
      words.push_back(std::exchange(word, {}));
    }
  }
  words.push_back(program);
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

/// Starts a program whose streams go to these files; between fork and exec nothing is allocated.
pid_t spawn(std::vector<std::string> words, const std::string& out, const std::string& err) {
  std::vector<char*> argv;
  for (std::string& word : words) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    constexpr int kFlags = O_WRONLY | O_CREAT | O_APPEND;
    dup2(open(out.c_str(), kFlags, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), kFlags, 0600), STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
  return child;
}

}  // namespace

Answered run_program(const std::string& program, const std::vector<std::string>& arguments) {
  const support::TemporaryFolder streams;
  const pid_t child =
      spawn(command_line(program, arguments), streams.path("out"), streams.path("err"));
  int raw = 0;
  waitpid(child, &raw, 0);
  return {WIFEXITED(raw) ? WEXITSTATUS(raw) : -1, streams.read("out"), streams.read("err")};
}

Daemon::~Daemon() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
}

void Daemon::write_settings(const std::string& more) const {
  const std::string recording = TUBESIGHT_TEST_DATA_DIR "/recordings/square_flush/";
  folder_.write("box.toml", "include = [\"" + recording +
                                "session.toml\"]\n[control]\nsocket = \"box\"\n"
                                "[source]\nkind = \"replay\"\nrecording = \"" +
                                recording + "recording.y4m.xz\"\n" + more);
}

void Daemon::write_simulated_settings(const std::string& more, std::string scenario) const {
  if (scenario.empty()) {
    scenario = folder_.write("plant.toml", "include = [\"" TUBESIGHT_SOURCE_DIR
                                           "/docs/examples/steam-generator.toml\"]\n"
                                           "[video]\nwindow_margin_px = 24\n");
  }
  folder_.write("box.toml",
                "[control]\nsocket = \"box\"\n[source]\nkind = \"simulated\"\nscenario = \"" +
                    scenario + "\"\n" + more);
}

void Daemon::start() {
  process_ = spawn(command_line(TUBESIGHT_DAEMON, {settings()}), folder_.path("said"),
                   folder_.path("said"));
}

bool Daemon::start_and_wait() {
  start();
  const auto until = Clock::now() + std::chrono::seconds(20);
  while (Clock::now() < until) {
    if (ask({"status"}).status == 0) {
      return true;
    }
    std::this_thread::sleep_for(milliseconds(20));
  }
  return false;
}

void Daemon::signal(int number) const { kill(process_, number); }

int Daemon::wait_for_end(milliseconds timeout) {
  const auto until = Clock::now() + timeout;
  int raw = 0;
  while (waitpid(process_, &raw, WNOHANG) == 0) {
    if (Clock::now() >= until) {
      return -2;
    }
    std::this_thread::sleep_for(milliseconds(5));
  }
  process_ = -1;
  return WIFEXITED(raw) ? WEXITSTATUS(raw) : -1;
}

Answered Daemon::ask(std::vector<std::string> arguments) const {
  arguments.insert(arguments.begin(), {"--socket", socket()});
  return run_program(TUBESIGHT_CTL, arguments);
}

std::string Daemon::wait_for(const std::string& part, milliseconds timeout) const {
  const auto until = Clock::now() + timeout;
  std::string answer;
  do {
    answer = ask({"status", "--json"}).out;
    if (answer.find(part) != std::string::npos) {
      break;
    }
    std::this_thread::sleep_for(milliseconds(20));
  } while (Clock::now() < until);
  return answer;
}

}  // namespace tubesight::tests
