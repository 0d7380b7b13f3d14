#include "board/bench/reconcile/job_list.h"

#include <algorithm>

#include "drivers/files/csv_reader.h"

namespace tubesight::board {
namespace {

/// Longest word of a job; more is another file.
constexpr std::size_t kLongestWord = 40;

/// Fit for a terminal and for a cell of a table, as it comes out again.
bool is_one_word(std::string_view text) {
  return std::none_of(text.begin(), text.end(), [](char letter) {
    return static_cast<unsigned char>(letter) < 0x21 || letter == 0x7f || letter == ',' ||
           letter == '"';
  });
}

bool take_job(const std::vector<std::string>& cells, Job& job, std::string& why) {
  job.kind = cells[0];
  if (job.kind.empty() || job.kind.size() > kLongestWord || !is_one_word(job.kind)) {
    why = "job: " + drivers::in_quotes(cells[0]) + ", expected a word such as plug";
    return false;
  }
  const auto leg = std::find(kLegWords.begin(), kLegWords.end(), cells[1]);
  if (leg == kLegWords.end()) {
    why = "leg: " + drivers::in_quotes(cells[1]) + ", expected hot or cold";
    return false;
  }
  job.leg = static_cast<Leg>(leg - kLegWords.begin());
  if (!drivers::parse_whole(cells[2], job.tube.row) ||
      !drivers::parse_whole(cells[3], job.tube.column)) {
    why = "row, column: " + drivers::in_quotes(cells[2] + "," + cells[3]) +
          ", expected two whole numbers";
    return false;
  }
  if (!cells[4].empty()) {
    job.done_at = parse_utc(cells[4]);
    if (!job.done_at) {
      why = "time_utc: " + drivers::in_quotes(cells[4]) +
            ", expected UTC as 2026-12-01T03:04:05Z, or nothing where it is still to be done";
      return false;
    }
  }
  return true;
}

}  // namespace

bool read_jobs(std::string_view text, const std::string& name, std::vector<Job>& jobs,
               drivers::Messages& messages) {
  jobs.clear();
  const std::size_t before = messages.size();
  drivers::CsvReader reader(text, name);
  if (!reader.read_header({"job", "leg", "row", "column", "time_utc"}, messages)) {
    return false;
  }
  while (reader.next(messages)) {
    Job job;
    job.line = reader.line_number();
    std::string why;
    if (take_job(reader.cells(), job, why)) {
      jobs.push_back(job);
    } else {
      messages.push_back(reader.place() + why);
      if (messages.size() - before >= drivers::CsvReader::kMostMessages) {
        break;
      }
    }
  }
  if (messages.size() == before && jobs.empty()) {
    messages.push_back(name + ": holds no job, expected a row for each");
  }
  return messages.size() == before;
}

}  // namespace tubesight::board
