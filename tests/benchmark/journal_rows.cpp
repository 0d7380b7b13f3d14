// What a journal of many rows costs: to append to, to open, to check, in bytes.
//
// Usage: journal_rows FILE ROWS    writes FILE anew, which must not be there, and leaves it
//
// Rows go in as a box's do at their worst, each another tube's verification, a thousand a
// transaction; then a hundred one by one, as a box appends them.
#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/journal/journal_check.h"
#include "drivers/journal/sqlite_journal.h"

namespace {

using namespace tubesight;
using Clock = std::chrono::steady_clock;

constexpr std::string_view kDigest =
    "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08";

hal::JournalRow row_of(std::int64_t number) {
  hal::JournalRow row;
  row.kind = hal::JournalKind::kVerification;
  row.time.boot_id = "c8f1b1c2-5a6e-4f0e-9a51-0d6f6d1f1b7e";
  row.time.monotonic = std::chrono::milliseconds(1000 * number);
  row.time.wall = std::chrono::milliseconds(1'790'000'000'000 + 1000 * number);
  row.time.wall_doubt = std::chrono::milliseconds(20);
  row.version = "1.0.0";
  row.origin = "robot";
  row.event_id = number;
  row.claimed = core::TubeAddress{static_cast<std::int32_t>(number % 97),
                                  static_cast<std::int32_t>(number % 113)};
  row.verdict = "confirmed";
  row.seen.tube = row.claimed;
  row.seen.offset_um = static_cast<std::int32_t>(number % 900);
  row.seen.height_um = 60'000;
  row.seen.margin_permyriad = 120'000;
  row.seen.residual_millipx = 80;
  row.seen.field = 60 * number;
  row.seen.field_time = std::chrono::milliseconds(1000 * number);
  row.seen.field_digest = kDigest;
  row.camera_id = kDigest.substr(0, 16);
  row.tool_id = kDigest.substr(16, 16);
  row.base_id = kDigest.substr(32, 16);
  row.first = row.time.monotonic;
  return row;
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

int fail(const std::string& why) {
  std::fprintf(stderr, "journal_rows: %s\n", why.c_str());
  return 1;
}

int measure(const std::string& path, std::int64_t rows) {
  drivers::SqliteJournal journal({path, path + ".key", 2000, ""});
  if (!journal.open(row_of(0))) {
    return fail(journal.message());
  }
  constexpr std::int64_t kTogether = 1000;
  auto begin = Clock::now();
  std::vector<hal::JournalRow> batch;
  for (std::int64_t done = 0; done < rows; done += kTogether) {
    batch.clear();
    for (std::int64_t i = done; i < std::min(rows, done + kTogether); ++i) {
      batch.push_back(row_of(i));
    }
    if (!journal.append(batch)) {
      return fail(journal.message());
    }
  }
  std::printf("rows a second, a thousand at once: %.0f\n",
              static_cast<double>(rows) / seconds_since(begin));
  std::array<double, 100> single_ms{};
  for (std::size_t i = 0; i < single_ms.size(); ++i) {
    const hal::JournalRow row = row_of(rows + static_cast<std::int64_t>(i));
    begin = Clock::now();
    if (!journal.append(std::span(&row, 1))) {
      return fail(journal.message());
    }
    single_ms[i] = 1e3 * seconds_since(begin);
  }
  std::sort(single_ms.begin(), single_ms.end());
  std::printf("one row at the end: median %.2f ms, longest of a hundred %.2f ms\n", single_ms[50],
              single_ms.back());
  journal.close();
  begin = Clock::now();
  if (!journal.open(row_of(0))) {
    return fail(journal.message());
  }
  std::printf("open: %.1f ms\n", 1e3 * seconds_since(begin));
  journal.close();
  std::printf("bytes a row: %.0f\n", static_cast<double>(std::filesystem::file_size(path)) /
                                         static_cast<double>(journal.last_safe()));
  begin = Clock::now();
  std::string message;
  const auto check = drivers::check_journal(path, {}, message);
  if (!check || check->wrong != 0 || check->rows != journal.last_safe()) {
    return fail(check ? "the journal is not whole" : message);
  }
  std::printf("check: %.1f s, %lld rows\n", seconds_since(begin),
              static_cast<long long>(check->rows));
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  std::int64_t rows = 0;
  if (count == 3) {
    const std::string_view text = arguments[2];
    const auto read = std::from_chars(text.data(), text.data() + text.size(), rows);
    rows = read.ptr == text.data() + text.size() ? rows : 0;
  }
  if (rows <= 0) {
    std::fputs("usage: journal_rows FILE ROWS\n", stderr);
    return 2;
  }
  if (std::filesystem::exists(arguments[1])) {
    return fail(std::string(arguments[1]) + ": is there already");
  }
  return measure(arguments[1], rows);
}
