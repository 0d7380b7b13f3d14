#include "board/bench/journal/journal_command.h"

#include <array>
#include <string>

#include "board/bench/output/output_paths.h"
#include "board/bench/output/text_output.h"
#include "board/bench/reconcile/journal_seal.h"
#include "drivers/files/atomic_file.h"
#include "drivers/journal/journal_check.h"
#include "drivers/journal/journal_copy.h"
#include "drivers/journal/journal_export.h"

namespace tubesight::board {
namespace {

ExitStatus refuse(const std::string& message) {
  tell(message);
  return ExitStatus::kWrongInput;
}

/// Who signed, and how far.
std::string signatures_text(const drivers::JournalCheck& found, bool key_given) {
  if (found.key.empty()) {
    return "not signed\n";
  }
  std::string text = counted(found.checkpoints, "checkpoint") + ", signed up to row " +
                     std::to_string(found.signed_through);
  const std::int64_t unsigned_rows = found.last - found.signed_through;
  text += unsigned_rows > 0 ? ", " + counted(unsigned_rows, "row") + " behind it not signed yet\n"
                            : "\n";
  return text + "key " + found.key +
         (key_given ? "\n" : ", which was not compared with one known (--key)\n");
}

std::string check_text(const drivers::JournalCheck& found, bool key_given) {
  std::string text = counted(found.rows, "row");
  text += found.rows > 0
              ? ", the last one " + std::to_string(found.last) + ", chain " + found.chain + "\n"
              : "\n";
  text += signatures_text(found, key_given);
  text += counted(found.pictures, "picture") + ", and the digests of " +
          std::to_string(found.pictures_dropped) + " that are not kept any more\n";
  return text +
         (found.wrong == 0 ? "nothing is wrong\n" : counted(found.wrong, "thing") + " wrong\n");
}

ExitStatus run_check(const JournalOptions& options) {
  std::string message;
  const auto journal = check_seal(options.journal, options.key, message, options.at_least);
  if (!journal) {
    return refuse(message);
  }
  for (const drivers::JournalProblem& problem : journal->check.problems) {
    tell(options.journal + ": " + problem.what);
  }
  const bool told = write_out(check_text(journal->check, journal->key_known));
  return told && journal->seal() != Seal::kBroken ? ExitStatus::kDone : ExitStatus::kJobFailed;
}

ExitStatus export_to(const std::string& journal, const std::string& path,
                     drivers::JournalFormat format) {
  drivers::AtomicFile file;
  std::string message;
  if (!open_output(file, path)) {
    tell(file.message());
    return ExitStatus::kJobFailed;
  }
  const auto written = drivers::export_journal(
      journal, format, [&](std::string_view text) { return static_cast<bool>(file.write(text)); },
      message);
  if (!written && written.error() != core::Error::kBufferTooSmall) {
    return refuse(message);
  }
  if (!written || !file.commit()) {
    tell(file.message());
    return ExitStatus::kJobFailed;
  }
  return ExitStatus::kDone;
}

ExitStatus run_export(const JournalOptions& options) {
  if (options.csv.empty() && options.json_lines.empty()) {
    return refuse("tubesight: journal: export needs --csv or --jsonl (tubesight help tells more)");
  }
  const std::array<NamedPath, 1> inputs = {{{"the journal", options.journal}}};
  const std::array<NamedPath, 2> outputs = {
      {{"--csv", options.csv}, {"--jsonl", options.json_lines}}};
  if (const std::string clash = find_clash(inputs, outputs); !clash.empty()) {
    return refuse(clash);
  }
  ExitStatus status = ExitStatus::kDone;
  if (!options.csv.empty()) {
    status = export_to(options.journal, options.csv, drivers::JournalFormat::kCsv);
  }
  if (status == ExitStatus::kDone && !options.json_lines.empty()) {
    status = export_to(options.journal, options.json_lines, drivers::JournalFormat::kJsonLines);
  }
  return status;
}

ExitStatus run_copy(const JournalOptions& options) {
  std::string message;
  const auto copied = drivers::copy_journal(options.journal, options.other, message);
  if (copied) {
    return ExitStatus::kDone;
  }
  tell(message);
  return copied.error() == core::Error::kIo ? ExitStatus::kJobFailed : ExitStatus::kWrongInput;
}

}  // namespace

ExitStatus run_journal(const JournalOptions& options) {
  const bool copies = options.action == "copy";
  const bool reconciles = options.action == "reconcile";
  if ((copies || reconciles) == options.other.empty()) {
    return refuse(copies ? "tubesight: journal: TO.db is missing, expected copy JOURNAL TO.db"
                  : reconciles
                      ? "tubesight: journal: the cold leg's journal is missing, expected "
                        "reconcile HOT.db COLD.db"
                      : "tubesight: journal: '" + options.other +
                            "' is one argument too many, expected " + options.action + " JOURNAL");
  }
  if (options.action == "check") {
    return run_check(options);
  }
  if (reconciles) {
    ReconcileOptions both = options.reconcile;
    both.hot = options.journal;
    both.cold = options.other;
    both.hot_key = options.key;
    both.csv = options.csv;
    return run_reconcile(both);
  }
  return copies ? run_copy(options) : run_export(options);
}

}  // namespace tubesight::board
