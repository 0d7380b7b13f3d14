#include "board/bench/journal_arguments.h"

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

#include "board/bench/number_range.h"

namespace tubesight::board {

CLI::App* add_journal(CLI::App& app, JournalOptions& options) {
  CLI::App* const journal = app.add_subcommand(
      "journal", "Checks, exports, copies or reconciles journals of what boxes have verified");
  journal->add_option("WHAT", options.action, "What to do: check, export, copy or reconcile")
      ->required()
      ->check(CLI::IsMember({"check", "export", "copy", "reconcile"}));
  journal->add_option("JOURNAL", options.journal, "The journal (SQLite), which is never changed")
      ->required();
  journal->add_option("OTHER.db", options.other,
                      "Of copy: the copy, a file that is not there yet; of reconcile: the cold "
                      "leg's journal, JOURNAL being the hot leg's");
  const auto add = [&](const char* name, std::string& value, const char* help, const char* text) {
    journal->add_option(name, value, help)->option_text(text);
  };
  add("--key", options.key,
      "With check and reconcile: the public key of JOURNAL's box, PEM or 64 hexadecimal digits",
      "KEY.pub");
  add("--second-key", options.reconcile.cold_key,
      "With reconcile: the public key of the cold leg's box", "KEY.pub");
  journal
      ->add_option("--at-least", options.at_least,
                   "With check: rows that must be there, as the box told them safe")
      ->option_text("N")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 53U));
  add("--csv", options.csv,
      "With export: write CSV, one row a row; with reconcile: one row a job and tube", "F.csv");
  add("--jsonl", options.json_lines, "With export: write JSON lines, an object a row", "F.jsonl");
  add("--jobs", options.reconcile.jobs,
      "With reconcile: what was done at which tube-end, and when; what is still to be done",
      "JOBS.csv");
  journal
      ->add_option("--mirrored", options.reconcile.mirrored_sum,
                   "With reconcile: the cold leg counts columns from the other side; a tube's "
                   "columns on both sheets add up to this")
      ->option_text("SUM");
  journal
      ->add_option("--hold", options.reconcile.hold_s,
                   "With reconcile: how long behind its last confirmation a tube-end counts as "
                   "vouched for, s; default 10")
      ->option_text("S")
      ->check(number_between(0.0, 3600.0));
  journal
      ->add_option("--clock-doubt", options.reconcile.clock_doubt_s,
                   "With reconcile: how far a box's wall clock may have been off where its journal "
                   "does not know, s; without it such rows close nothing")
      ->option_text("S")
      ->check(number_between(0.0, 3600.0));
  journal->add_flag("--accept-unsigned", options.reconcile.accept_unsigned,
                    "With reconcile: rows that no signature covers close jobs, too");
  journal->add_flag("--accept-broken", options.reconcile.accept_broken,
                    "With reconcile: so do rows of a journal that is not what was written");
  return journal;
}

}  // namespace tubesight::board
