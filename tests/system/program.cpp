#include "tests/system/program.h"

#include <cstdlib>

#include <sys/wait.h>

namespace tubesight::tests {
namespace {

std::string quoted(const std::string& word) {
  std::string result = "'";
  for (const char c : word) {
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return result + "'";
}

}  // namespace

ProgramRun run_tubesight(const support::TemporaryFolder& folder,
                         const std::vector<std::string>& arguments, const std::string& input) {
  const support::TemporaryFolder streams;
  std::string command =
      "cd " + quoted(folder.path("")) + " && " TUBESIGHT_EMULATOR " " + quoted(TUBESIGHT_PROGRAM);
  for (const std::string& argument : arguments) {
    command += " " + quoted(argument);
  }
  command += input.empty() ? "" : " < " + quoted(folder.path(input));
  command += " > " + quoted(streams.path("out")) + " 2> " + quoted(streams.path("err"));
  const int raw = std::system(command.c_str());
  ProgramRun run;
  run.status = WIFEXITED(raw) ? WEXITSTATUS(raw) : -1;
  run.out = streams.read("out");
  run.err = streams.read("err");
  return run;
}

}  // namespace tubesight::tests
