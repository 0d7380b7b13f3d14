#include "board/bench/reconcile/reconcile_command.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <vector>

#include "board/bench/output/output_paths.h"
#include "board/bench/output/text_output.h"
#include "board/bench/reconcile/job_list.h"
#include "board/bench/reconcile/journal_evidence.h"
#include "board/bench/reconcile/journal_seal.h"
#include "board/bench/reconcile/reconciliation.h"
#include "board/bench/reconcile/reconciliation_text.h"
#include "drivers/files/atomic_file.h"
#include "drivers/journal/journal_reader.h"
#include "drivers/settings/text_files.h"

namespace tubesight::board {
namespace {

/// A leg's journal as it was read.
struct ReadLeg {
  SealedJournal journal;
  std::string first_chain;  ///< of its first row, which no other journal has
  LegRecord record;
};

ExitStatus refuse(const std::string& message) {
  tell(message);
  return ExitStatus::kWrongInput;
}

std::int64_t trusted_through(const SealedJournal& journal, const ReconcileOptions& options) {
  const bool broken = journal.seal() == Seal::kBroken;
  if (broken && !options.accept_broken) {
    return 0;
  }
  return options.accept_unsigned ? journal.check.last : journal.check.signed_through;
}

bool read_leg(const std::string& path, const std::string& key, const ReconcileOptions& options,
              ReadLeg& leg, std::string& message) {
  auto sealed = check_seal(path, key, message);
  if (!sealed) {
    return false;
  }
  leg.journal = std::move(*sealed);
  drivers::JournalReader reader;
  std::optional<std::chrono::milliseconds> assumed;
  if (options.clock_doubt_s) {
    assumed = std::chrono::milliseconds(
        static_cast<std::int64_t>(std::ceil(1000.0 * *options.clock_doubt_s)));
  }
  JournalEvidence evidence(assumed);
  auto read = reader.open(path);
  if (read) {
    // What a box has appended since the check was not checked.
    read = reader.read(leg.journal.check.last, [&](const drivers::JournalEntry& entry) {
      leg.first_chain = entry.number == 1 ? entry.chain : leg.first_chain;
      evidence.add(entry);
    });
  }
  if (!read) {
    message = reader.message();
    return false;
  }
  leg.record.evidence = evidence.take(trusted_through(leg.journal, options));
  return true;
}

/// What stands above the findings, of one leg.
std::string leg_text(std::string_view leg, const ReadLeg& read, const ReconcileOptions& options) {
  const SealedJournal& journal = read.journal;
  std::string text = std::string(leg) + " leg, " + journal.path + ": " + seal_text(journal) + '\n';
  const std::int64_t trusted = trusted_through(journal, options);
  if (trusted == 0) {
    text += "    It closes no job (" +
            std::string(journal.seal() == Seal::kBroken ? "--accept-broken" : "--accept-unsigned") +
            " would have it so).\n";
  } else if (trusted < journal.check.last) {
    text += "    Rows behind row " + std::to_string(trusted) +
            " close no job (--accept-unsigned would have it so).\n";
  }
  return text;
}

bool write_rows(const std::string& path, std::span<const ReconciledTube> tubes) {
  if (path.empty()) {
    return true;
  }
  drivers::AtomicFile file;
  const bool written = open_output(file, path) &&
                       file.write(std::string(kReconciledHeader) + '\n') &&
                       file.write(reconciliation_rows(tubes)) && file.commit();
  if (!written) {
    tell(file.message());
  }
  return written;
}

std::string find_mistake(const ReconcileOptions& options) {
  if (options.jobs.empty()) {
    return "tubesight: journal: reconcile needs --jobs JOBS.csv (tubesight help tells more)";
  }
  std::error_code ignored;
  if (std::filesystem::equivalent(options.hot, options.cold, ignored)) {
    return options.cold + ": is the hot leg's journal, expected that of the cold leg";
  }
  const std::array<NamedPath, 5> inputs = {{{"the hot leg's journal", options.hot},
                                            {"the cold leg's journal", options.cold},
                                            {"--jobs", options.jobs},
                                            {"--key", options.hot_key},
                                            {"--second-key", options.cold_key}}};
  const std::array<NamedPath, 1> outputs = {{{"--csv", options.csv}}};
  return find_clash(inputs, outputs);
}

}  // namespace

ExitStatus run_reconcile(const ReconcileOptions& options) {
  if (const std::string mistake = find_mistake(options); !mistake.empty()) {
    return refuse(mistake);
  }
  std::string text;
  std::string message;
  if (!drivers::DiskFiles().read(options.jobs, text, message)) {
    return refuse(options.jobs + ": " + message);
  }
  std::vector<Job> jobs;
  drivers::Messages messages;
  if (!read_jobs(text, options.jobs, jobs, messages)) {
    tell(messages);
    return ExitStatus::kWrongInput;
  }
  std::array<ReadLeg, 2> legs;
  if (!read_leg(options.hot, options.hot_key, options, legs[0], message) ||
      !read_leg(options.cold, options.cold_key, options, legs[1], message)) {
    return refuse(message);
  }
  if (!legs[0].first_chain.empty() && legs[0].first_chain == legs[1].first_chain) {
    return refuse(options.cold + ": begins with the row that " + options.hot +
                  " begins with, expected another journal: one leg's is no proof of the other");
  }
  std::string heading;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    for (const drivers::JournalProblem& problem : legs[i].journal.check.problems) {
      tell(legs[i].journal.path + ": " + problem.what);
    }
    heading += leg_text(kLegWords[i], legs[i], options);
  }
  legs[1].record.numbering.mirrored_sum = options.mirrored_sum;
  const auto hold = std::chrono::milliseconds(static_cast<std::int64_t>(1000.0 * options.hold_s));
  const std::vector<ReconciledTube> tubes =
      reconcile(jobs, {std::move(legs[0].record), std::move(legs[1].record)}, hold);
  const bool told =
      write_out(heading + reconciliation_text(tubes), goes_to_standard_output({options.csv}));
  const bool closed = std::all_of(tubes.begin(), tubes.end(), [](const ReconciledTube& tube) {
    return tube.finding == TubeFinding::kClosed;
  });
  return write_rows(options.csv, tubes) && told && closed ? ExitStatus::kDone
                                                          : ExitStatus::kJobFailed;
}

}  // namespace tubesight::board
