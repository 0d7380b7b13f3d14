#include "board/bench/argument_words.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <vector>

#include <CLI/CLI.hpp>

#include "board/bench/argument_files.h"
#include "board/bench/calibrate_arguments.h"
#include "board/bench/nearest_word.h"

namespace tubesight::board {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

std::string meant(const std::string& word, const std::vector<std::string>& words) {
  const std::string nearest = nearest_word(word, words);
  return nearest.empty() ? "" : ", did you mean " + nearest + "?";
}

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* const command : app.get_subcommands({})) {
    names.push_back(command->get_name());
  }
  return names;
}

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* const option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      names.push_back("--" + name);
    }
  }
  return names;
}

bool looks_like_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && std::isdigit(word[1]) == 0 && word[1] != '.';
}

/// The arguments that stand without a name, as the help has them.
std::string usage_of(const CLI::App& command) {
  std::string usage;
  for (const CLI::Option* const option : command.get_options()) {
    if (option->get_positional()) {
      usage += (usage.empty() ? "" : " ") + option->get_name(true);
    }
  }
  return usage;
}

/// What an option's value is: "F.csv: Write one row a field".
std::string value_of(const CLI::Option& option) {
  const std::string name = option.get_option_text();
  return (name.empty() ? "" : name + ": ") + option.get_description();
}

/// An option whose value is missing, also where the next option was taken for it.
std::string find_missing_value(const CLI::App& command, const std::string& problem) {
  const std::vector<std::string> names = options_of(command);
  for (const CLI::Option* const option : command.get_options()) {
    const auto& values = option->results();
    const bool taken = std::any_of(values.begin(), values.end(), [&](const std::string& value) {
      return std::find(names.begin(), names.end(), value) != names.end();
    });
    const bool named = problem.rfind(option->get_name() + ": ", 0) == 0;
    if (taken || (named && values.empty())) {
      return option->get_name() + ": its value is missing, expected " + value_of(*option);
    }
    const bool single = option->get_expected_max() == 1 && values.size() > 1;
    if (named && single) {
      return option->get_name() + ": it is there " + std::to_string(values.size()) +
             " times, expected once";
    }
    if (named && values.size() < static_cast<std::size_t>(option->get_expected_min())) {
      return option->get_name() + ": too few values, expected " + value_of(*option);
    }
  }
  return {};
}

/// "RECORDING is required" as what RECORDING is.
std::string find_missing_argument(const CLI::App& command) {
  for (const CLI::Option* const option : command.get_options()) {
    if (option->get_required() && option->count() == 0) {
      const bool positional = option->get_positional();
      return option->get_name(positional) + " is missing, expected " +
             (positional ? usage_of(command) + " (" + option->get_name(true) +
                               " is: " + option->get_description() + ")"
                         : value_of(*option));
    }
  }
  return {};
}

std::string find_unknown_option(const CLI::App& app, const CLI::App& command) {
  for (const std::string& word : app.remaining(true)) {
    if (!looks_like_option(word)) {
      continue;
    }
    const std::string name = word.substr(0, word.find('='));
    const auto of_program = options_of(app);
    const bool elsewhere =
        std::find(of_program.begin(), of_program.end(), name) != of_program.end();
    return "'" + name + "' is no option" +
           (elsewhere ? " of it, expected tubesight " + name : meant(name, options_of(command)));
  }
  return {};
}

/// `calibrate session.toml tool`
std::string find_swapped_words(const CLI::App& command) {
  const CLI::Option* const what = command.get_option_no_throw("WHAT");
  const CLI::Option* const file = command.get_option_no_throw("FILE");
  if (what == nullptr || file == nullptr || what->count() == 0) {
    return {};
  }
  const std::vector<std::string> words(kCalibrations.begin(), kCalibrations.end());
  const auto is_word = [&](const std::string& text) {
    return std::find(words.begin(), words.end(), text) != words.end();
  };
  const std::string& given = what->results()[0];
  if (is_word(given)) {
    return {};
  }
  if (file->count() > 0 && is_word(file->results()[0])) {
    return "'" + given + "' and '" + file->results()[0] + "' are swapped, expected calibrate " +
           file->results()[0] + " " + given;
  }
  return "'" + given + "' is nothing to calibrate" + meant(given, words) + " Expected one of " +
         joined(words);
}

}  // namespace

std::string why_no_command(const CLI::App& app, const std::string& word) {
  const std::vector<std::string> commands = commands_of(app);
  if (std::find(commands.begin(), commands.end(), word) != commands.end()) {
    return {};
  }
  std::string options = meant(word, commands);
  return "'" + word + "' is no command" + (options.empty() ? "," : options + " Else") +
         " expected one of " + joined(commands);
}

std::string explain_refusal(const CLI::App& app, const CLI::ParseError& problem) {
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) {
    for (const std::string& word : app.remaining()) {
      if (looks_like_option(word)) {
        const std::string better = meant(word, options_of(app));
        return "'" + word + "' is no option" + (better.empty() ? ":" : better) +
               " a command comes first, one of " + joined(commands_of(app));
      }
    }
    return "no command, expected one of " + joined(commands_of(app));
  }
  const CLI::App& command = *chosen.front();
  std::string text = find_unknown_option(app, command);
  if (text.empty()) {
    text = find_missing_value(command, problem.what());
  }
  if (text.empty()) {
    text = find_swapped_words(command);
  }
  if (text.empty() && problem.get_name() == "RequiredError") {
    text = find_missing_argument(command);
  }
  const std::vector<std::string> surplus = app.remaining(true);
  if (text.empty() && !surplus.empty()) {
    const std::string usage = usage_of(command);
    text = "'" + surplus.front() + "' is one argument too many, expected " +
           (usage.empty() ? "none" : usage) + "; a name with spaces needs quotation marks";
  }
  if (text.empty()) {
    text = problem.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
  }
  return command.get_name() + ": " + text;
}

/// What the files that options name must be.
const std::map<std::pair<std::string, std::string>, std::vector<FileKind>> kOptionFiles = {
    {{"new", "--from"}, {FileKind::kRecording, FileKind::kPicture}},
    {{"new", "--camera"}, {FileKind::kSettings, FileKind::kCameraYaml}},
    {{"calibrate", "--sheet"}, {FileKind::kSettings}},
    {{"calibrate", "--touches"}, {FileKind::kTable}},
    {{"calibrate", "--points"}, {FileKind::kTable}},
    {{"calibrate", "--base"}, {FileKind::kSettings}},
    {{"calibrate", "--arm"}, {FileKind::kSettings, FileKind::kScenario}},
    {{"campaign", "--resume"}, {FileKind::kTable}},
    {{"campaign", "--merge"}, {FileKind::kTable}},
};

std::string find_wrong_arguments(const CLI::App& command) {
  std::vector<ArgumentFile> files;
  std::string what;
  for (const CLI::Option* const option : command.get_options()) {
    const std::string name = option->get_name(option->get_positional());
    for (const std::string& value : option->results()) {
      if (value.empty()) {
        return command.get_name() + ": " + name + ": its value is empty, expected " +
               value_of(*option);
      }
      if (option->get_positional() && name == "WHAT") {
        what = value;
      } else if (option->get_positional()) {
        files.push_back({name, value});
      } else if (const auto kinds = kOptionFiles.find({command.get_name(), name});
                 kinds != kOptionFiles.end()) {
        if (std::string wrong = find_other_kind({name, value}, kinds->second); !wrong.empty()) {
          return command.get_name() + ": " + wrong;
        }
      }
    }
  }
  // What the first file must be, by command or by what is calibrated; `look` has pictures alone.
  const std::map<std::string, FileKind> first = {
      {"replay", FileKind::kSettings}, {"pose", FileKind::kSettings},
      {"budget", FileKind::kSettings}, {"simulate", FileKind::kScenario},
      {"tool", FileKind::kSettings},   {"camera", FileKind::kTarget},
      {"base", FileKind::kTable},      {"zones", FileKind::kTable},
      {"links", FileKind::kTable},     {"import", FileKind::kCameraYaml},
  };
  const auto wanted = first.find(what.empty() ? command.get_name() : what);
  std::string wrong;
  if (wanted != first.end()) {
    wrong = find_mixed_up(files, wanted->second, usage_of(command));
  } else if (command.get_name() == "look") {
    files.insert(files.begin(), ArgumentFile{});  // nothing stands before the pictures
    wrong = find_mixed_up(files, FileKind::kUnknown, usage_of(command));
  }
  return wrong.empty() ? "" : command.get_name() + (what.empty() ? "" : " " + what) + ": " + wrong;
}

}  // namespace tubesight::board
