#include "drivers/recording/recording_folder.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "drivers/files/atomic_file.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::string_view kPrefix = "box-";
constexpr std::string_view kStamp =
    "dddddddd"
    "T"
    "dddddd"
    "Z";  // d: a digit
constexpr std::size_t kDigits = 6;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// What a file's name says when it is one of ours.
struct Named {
  std::int64_t number = 0;
  std::string name;         ///< of the recording, without ending
  std::string_view ending;  ///< what follows it
};

std::optional<Named> parse_name(std::string_view file) {
  std::string_view rest = file;
  const auto cut = [&rest](std::string_view start) {
    const bool has = rest.starts_with(start);
    rest.remove_prefix(has ? start.size() : 0);
    return has;
  };
  if (!cut(kPrefix)) {
    return {};
  }
  Named named;
  std::size_t digits = 0;
  for (; digits < rest.size() && is_digit(rest[digits]); ++digits) {
    named.number = 10 * named.number + (rest[digits] - '0');
    if (digits > 12) {
      return {};
    }
  }
  rest.remove_prefix(digits);
  if (digits < kDigits || !cut("-") || rest.size() < kStamp.size()) {
    return {};
  }
  for (std::size_t i = 0; i < kStamp.size(); ++i) {
    if (kStamp[i] == 'd' ? !is_digit(rest[i]) : rest[i] != kStamp[i]) {
      return {};
    }
  }
  rest.remove_prefix(kStamp.size());
  if (!cut("-") || (!cut(word_of(hal::RecordingReason::kDisagreement)) &&
                    !cut(word_of(hal::RecordingReason::kTrackLost)) &&
                    !cut(word_of(hal::RecordingReason::kCommand)))) {
    return {};
  }
  named.name = file.substr(0, file.size() - rest.size());
  named.ending = rest;
  return named;
}

bool is_ending(std::string_view text) {
  return std::find(std::begin(RecordingFolder::kEndings), std::end(RecordingFolder::kEndings),
                   text) != std::end(RecordingFolder::kEndings);
}

/// A file that AtomicFile had not put in its place: "ENDING.PID-N.part".
bool is_unfinished(std::string_view text) {
  if (!text.ends_with(".part")) {
    return false;
  }
  text.remove_suffix(std::string_view(".part").size());
  const std::size_t dot = text.rfind('.');
  return dot != std::string_view::npos && is_ending(text.substr(0, dot));
}

}  // namespace

std::string_view word_of(hal::RecordingReason reason) {
  switch (reason) {
    case hal::RecordingReason::kDisagreement: return "disagreement";
    case hal::RecordingReason::kTrackLost: return "track-lost";
    case hal::RecordingReason::kCommand: return "command";
  }
  return "";
}

FolderClaim::Outcome FolderClaim::take(const std::string& folder) {
  release();
  struct stat there {};
  if (stat(folder.c_str(), &there) != 0) {
    return Outcome::kFailed;
  }
  const std::string name =
      "tubesight-recordings-" + std::to_string(there.st_dev) + "-" + std::to_string(there.st_ino);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::copy(name.begin(), name.end(), &address.sun_path[1]);  // behind a 0: no file
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  fd_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  // The interface of sockets. NOLINTNEXTLINE(*-reinterpret-cast)
  if (fd_ >= 0 && bind(fd_, reinterpret_cast<const sockaddr*>(&address), length) == 0) {
    return Outcome::kHeld;
  }
  const int why = errno;
  release();
  errno = why;
  return why == EADDRINUSE ? Outcome::kTaken : Outcome::kFailed;
}

void FolderClaim::release() {
  if (fd_ >= 0) {
    close(fd_);
    fd_ = -1;
  }
}

Result<void> RecordingFolder::fail(Error error, std::string message) {
  message_ = std::move(message);
  return Unexpected(error);
}

Result<void> RecordingFolder::list(std::vector<Entry>& entries, bool remove_unfinished) {
  entries.clear();
  std::error_code error;
  std::filesystem::directory_iterator file(folder_, error);
  for (; !error && file != std::filesystem::directory_iterator(); file.increment(error)) {
    const std::string name = file->path().filename().string();
    const auto named = parse_name(name);
    if (!named) {
      continue;
    }
    if (remove_unfinished && is_unfinished(named->ending)) {
      std::error_code ignored;
      std::filesystem::remove(file->path(), ignored);
      continue;
    }
    if (!is_ending(named->ending)) {
      continue;
    }
    auto entry = std::find_if(entries.begin(), entries.end(),
                              [&](const Entry& known) { return known.name == named->name; });
    if (entry == entries.end()) {
      entry = entries.insert(entries.end(), Entry{named->number, named->name, 0, false});
    }
    std::error_code unknown;
    const auto bytes = std::filesystem::file_size(file->path(), unknown);
    entry->bytes += unknown ? 0 : static_cast<std::int64_t>(bytes);
    entry->has_picture = entry->has_picture || named->ending == ".y4m";
    last_number_ = std::max(last_number_, named->number);
  }
  if (error) {
    return fail(Error::kIo, folder_ + ": cannot be read: " + error.message());
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::pair(a.number, a.name) < std::pair(b.number, b.name);
  });
  return {};
}

Result<void> RecordingFolder::open() {
  switch (claim_.take(folder_)) {
    case FolderClaim::Outcome::kHeld: break;
    case FolderClaim::Outcome::kTaken:
      return fail(Error::kNotReady, folder_ + ": another box records there");
    case FolderClaim::Outcome::kFailed:
      return fail(Error::kIo, folder_ + ": cannot be read: " + std::strerror(errno));
  }
  std::vector<Entry> entries;
  TUBESIGHT_TRY(list(entries, true));
  for (const Entry& entry : entries) {
    if (!entry.has_picture) {
      remove(path_of(entry.name));
    }
  }
  return {};
}

std::int64_t RecordingFolder::free_on_disk(const std::string& folder) {
  std::error_code error;
  const auto space = std::filesystem::space(folder, error);
  return error ? 0 : static_cast<std::int64_t>(space.available);
}

Result<std::int64_t> RecordingFolder::room() {
  std::vector<Entry> entries;
  if (const auto listed = list(entries, false); !listed) {
    return Unexpected(listed.error());
  }
  std::int64_t room = free_(folder_);
  for (const Entry& entry : entries) {
    room += entry.bytes;
  }
  return std::min(room, most_bytes_);
}

Result<void> RecordingFolder::make_room(std::int64_t bytes) {
  if (bytes > most_bytes_) {
    return fail(Error::kOutOfRange, folder_ + ": a recording of " + std::to_string(bytes) +
                                        " bytes, expected at most the " +
                                        std::to_string(most_bytes_) + " of all recordings");
  }
  std::vector<Entry> entries;
  TUBESIGHT_TRY(list(entries, false));
  std::int64_t sum = bytes;
  for (const Entry& entry : entries) {
    sum += entry.bytes;
  }
  std::int64_t free = free_(folder_);
  if (free + sum - bytes < bytes) {
    return fail(Error::kIo, folder_ + ": the disk is full, expected room for " +
                                std::to_string(bytes) + " bytes");
  }
  for (const Entry& oldest : entries) {
    if (sum <= most_bytes_ && bytes <= free) {
      return {};
    }
    remove(path_of(oldest.name));
    sum -= oldest.bytes;
    free += oldest.bytes;
    std::error_code ignored;
    if (std::filesystem::exists(path_of(oldest.name) + ".y4m", ignored)) {
      return fail(Error::kIo, path_of(oldest.name) + ".y4m: cannot be removed");
    }
  }
  return {};
}

Result<void> RecordingFolder::sync() {
  return sync_folder(folder_) ? Result<void>() : fail(Error::kIo, folder_ + ": cannot be written");
}

std::string RecordingFolder::next_path(std::int64_t utc_s, hal::RecordingReason reason) {
  constexpr std::int64_t kDay_s = 86400;
  constexpr std::int64_t kLatest_s = 253'402'300'799;  // the end of the year 9999
  utc_s = std::clamp<std::int64_t>(utc_s, 0, kLatest_s);
  const std::chrono::year_month_day date{std::chrono::sys_days{std::chrono::days{utc_s / kDay_s}}};
  const auto second = static_cast<int>(utc_s % kDay_s);
  char text[64];
  std::snprintf(text, sizeof text, "%06lld-%04d%02u%02uT%02d%02d%02dZ-",
                static_cast<long long>(++last_number_), static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                second / 3600, second / 60 % 60, second % 60);
  return path_of(std::string(kPrefix) + text + std::string(word_of(reason)));
}

void RecordingFolder::remove(const std::string& path) const {
  // The picture first: what is left when this is interrupted is known as remains.
  for (auto ending = std::rbegin(kEndings); ending != std::rend(kEndings); ++ending) {
    std::error_code ignored;
    std::filesystem::remove(path + std::string(*ending), ignored);
  }
}

}  // namespace tubesight::drivers
