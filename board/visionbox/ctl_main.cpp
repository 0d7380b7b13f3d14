// tubesightctl: asks a running box.

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "board/box/version.h"
#include "board/visionbox/control_protocol.h"
#include "board/visionbox/page_tools.h"
#include "board/visionbox/program_arguments.h"
#include "drivers/control/control_client.h"

namespace tubesight::board {
namespace {

constexpr int kDone = 0;
constexpr int kBoxRefused = 1;  ///< or a self-test that found something
constexpr int kNoBox = 3;

struct Options {
  std::string socket = kUsualControlSocket;
  bool json = false;
  std::string tubes;
  std::string place;
  std::int64_t field = -1;
  bool confirm = false;
  std::string level;  ///< of the lamp
  std::string role;   ///< whose password
  std::string file;   ///< of passwords, or the certificate
  std::string key;    ///< of the certificate
  std::vector<std::string> names;
};

void add_field(CLI::App& command, Options& options) {
  command
      .add_option("--field", options.field,
                  "Number of the field in whose picture it was seen; default: the next one")
      ->option_text("N")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 53U));
}

void add_commands(CLI::App& app, Options& options) {
  app.add_option("--socket", options.socket,
                 "Where the box listens; default /run/tubesight/control")
      ->option_text("PATH");
  app.add_subcommand("status", "How the box is doing")
      ->add_flag("--json", options.json, "Print the box's answer as it is");
  CLI::App* const start = app.add_subcommand("start", "Name tubes, so that the box tracks");
  start->add_option("TUBES", options.tubes,
                    "\"ROW,COLUMN,U,V;...\": where in the picture they are, px; default: [start]");
  start->add_flag("--confirm", options.confirm, "Insist on it against a warning");
  add_field(*start, options);
  CLI::App* const pick = app.add_subcommand("pick", "Which tube stands at a place of the picture");
  pick->add_option("PLACE", options.place, "U,V: the place, px")->required();
  add_field(*pick, options);
  app.add_subcommand("lamp", "Set the lamp's level, or let the box find it")
      ->add_option("PERMILLE", options.level, "0 (dark) to 1000, or auto")
      ->required()
      ->check(CLI::Range(0, 1000) | CLI::IsMember({"auto"}));
  app.add_subcommand("record", "Let the box write its last fields to disk");
  app.add_subcommand("self-test", "Whether everything of the box works")
      ->add_flag("--json", options.json, "Print the box's answer as it is");
}

void add_page_commands(CLI::App& app, Options& options) {
  CLI::App* const password = app.add_subcommand(
      "page-password", "Set a password of the operator's page, read from standard input");
  password->add_option("FILE", options.file, "File of passwords ([page] passwords)")->required();
  password->add_option("ROLE", options.role, "viewer, operator or engineer")
      ->required()
      ->check(CLI::IsMember({"viewer", "operator", "engineer"}));
  CLI::App* const certificate = app.add_subcommand(
      "page-certificate", "Make a certificate for the operator's page, and print its fingerprint");
  certificate->add_option("CERTIFICATE", options.file, "New file ([page] certificate)")->required();
  certificate->add_option("KEY", options.key, "New file ([page] key)")->required();
  certificate->add_option("NAMES", options.names, "Names and addresses of the box")->required();
}

std::string request(const std::string& command, const Options& options) {
  std::string line = std::to_string(kControlVersion) + " " + command;
  const auto append = [&line](const std::string& word) {
    if (!word.empty()) {
      line += " " + word;
    }
  };
  if (command == "start") {
    append(options.tubes);
    append(options.confirm ? "confirm" : "");
  } else if (command == "pick") {
    append(options.place);
  } else if (command == "lamp") {
    append(options.level);
  }
  append(options.field >= 0 ? "field=" + std::to_string(options.field) : "");
  return line;
}

int ask(const std::string& command, const Options& options) {
  constexpr std::chrono::seconds kPatience{5};
  constexpr std::chrono::seconds kRecordingPatience{70};  // it goes on a while, and is written
  drivers::ControlConnection box;
  std::string answer;
  const std::chrono::milliseconds patience = command == "record" ? kRecordingPatience : kPatience;
  if (!box.open(options.socket) || !box.ask(request(command, options), patience, answer)) {
    std::fprintf(stderr, "tubesightctl: %s\n", box.message().c_str());
    return kNoBox;
  }
  const bool good = answer.find("\"ok\":true") != std::string::npos;
  if (options.json) {
    std::printf("%s\n", answer.c_str());
  } else {
    const std::string text = drivers::find_json_string(answer, "text");
    std::fprintf(good || command == "self-test" ? stdout : stderr, "%s\n",
                 text.empty() ? answer.c_str() : text.c_str());
  }
  if (std::fflush(stdout) != 0) {
    std::perror("standard output: cannot be written");
    return kBoxRefused;
  }
  return good ? kDone : kBoxRefused;
}

int run_program(int argc, const char* const* argv) {
  CLI::App app("Asks a running vision box (tubesightd)", "tubesightctl");
  app.set_version_flag("--version", version_text("tubesightctl"),
                       "Print version, commit and arithmetic, and exit");
  app.require_subcommand(1);
  Options options;
  add_commands(app, options);
  add_page_commands(app, options);
  if (const auto status = read_arguments(app, argc, argv)) {
    return *status;
  }
  if (options.place.find_first_of(" \n") != std::string::npos ||
      options.tubes.find_first_of(" \n") != std::string::npos) {
    std::fprintf(stderr, "tubesightctl: a space in a place, expected numbers and commas alone\n");
    return kWrongInput;
  }
  const std::string command = app.get_subcommands().front()->get_name();
  if (command == "page-password") {
    return set_page_password(options.file, options.role);
  }
  if (command == "page-certificate") {
    return make_page_certificate(options.file, options.key, options.names);
  }
  return ask(command, options);
}

}  // namespace
}  // namespace tubesight::board

int main(int argc, char** argv) {
  try {
    return tubesight::board::run_program(argc, argv);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "tubesightctl: stopped: %s\n", problem.what());
    return tubesight::board::kBoxRefused;
  }
}
