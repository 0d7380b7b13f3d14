#include "board/bench/journal_arguments.h"

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

namespace tubesight::board {

CLI::App* add_journal(CLI::App& app, JournalOptions& options) {
  CLI::App* const journal = app.add_subcommand(
      "journal", "Checks, exports or copies the journal of what a box has verified");
  journal->add_option("WHAT", options.action, "What to do with it: check, export or copy")
      ->required()
      ->check(CLI::IsMember({"check", "export", "copy"}));
  journal->add_option("JOURNAL", options.journal, "The journal (SQLite), which is never changed")
      ->required();
  journal->add_option("TO.db", options.copy, "Of copy: the copy, a file that is not there yet");
  const auto add = [&](const char* name, std::string& value, const char* help, const char* text) {
    journal->add_option(name, value, help)->option_text(text);
  };
  add("--key", options.key, "With check: the box's public key, PEM or 64 hexadecimal digits",
      "KEY.pub");
  journal
      ->add_option("--at-least", options.at_least,
                   "With check: rows that must be there, as the box told them safe")
      ->option_text("N")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 53U));
  add("--csv", options.csv, "With export: write CSV, one row a row", "F.csv");
  add("--jsonl", options.json_lines, "With export: write JSON lines, an object a row", "F.jsonl");
  return journal;
}

}  // namespace tubesight::board
