#include "board/visionbox/log.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cinttypes>
#include <cstdlib>

#include <sys/stat.h>
#include <unistd.h>

namespace tubesight::board {
namespace {

constexpr double kMostAtOnce = 20.0;
constexpr double kLinesASecond = 0.5;
/// Of one kind, within its time.
constexpr std::int64_t kMostOfAKind = 4;
constexpr MonotonicTime kTimeOfAKind = std::chrono::seconds(60);
constexpr std::size_t kLongestLine = 800;

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  if (text.size() > kLongestLine) {
    text.resize(kLongestLine);
    text += " ...";
  }
  return text;
}

/// Numbers out: "3 sightings came late" and "5 sightings came late" are of one kind.
std::string kind_of(const std::string& line) {
  std::string kind;
  for (const char c : line) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (!digit || kind.empty() || kind.back() != '#') {
      kind += digit ? '#' : c;
    }
  }
  return kind;
}

struct Words {
  std::string_view part;
  LogLevel level;
};
/// The first that a line has counts.
constexpr std::array kLevels{
    Words{"vouches for nothing", LogLevel::kCritical},
    Words{"stands still: ", LogLevel::kCritical},
    Words{"nothing is bad", LogLevel::kInfo},
    Words{"tracking: lost", LogLevel::kWarning},
    Words{"self-test: bad", LogLevel::kError},
    Words{"cannot be", LogLevel::kError},
    Words{"refuses", LogLevel::kError},
    Words{"failed", LogLevel::kError},
    Words{"is gone", LogLevel::kError},
    Words{"is not there", LogLevel::kError},
    Words{"not numbered", LogLevel::kWarning},
    Words{"not locked", LogLevel::kWarning},
    Words{"no real-time priority", LogLevel::kWarning},
    Words{"the box goes on", LogLevel::kWarning},
    Words{"after the deadline", LogLevel::kWarning},
    Words{"after their instant", LogLevel::kWarning},
    Words{"left out", LogLevel::kWarning},
};

}  // namespace

LogLevel level_of(std::string_view line) {
  for (const Words& words : kLevels) {
    if (line.find(words.part) != std::string_view::npos) {
      return words.level;
    }
  }
  return LogLevel::kInfo;
}

bool stderr_is_journal() {
  const char* const told = std::getenv("JOURNAL_STREAM");
  std::uint64_t device = 0;
  std::uint64_t inode = 0;
  struct stat status {};
  return told != nullptr && std::sscanf(told, "%" SCNu64 ":%" SCNu64, &device, &inode) == 2 &&
         fstat(STDERR_FILENO, &status) == 0 && status.st_dev == device && status.st_ino == inode;
}

Log::Log() : Log(stderr_is_journal()) {}

void Log::print(const std::string& line) {
  if (to_journal_) {
    std::fprintf(stderr, "<%d>", static_cast<int>(level_of(line)));
  }
  std::fprintf(stderr, "tubesightd: %s\n", line.c_str());
}

bool Log::allowed(MonotonicTime now) {
  const std::chrono::duration<double> since = now - last_;
  allowance_ = std::min(kMostAtOnce, allowance_ + kLinesASecond * since.count());
  last_ = now;
  if (allowance_ < 1.0) {
    return false;
  }
  allowance_ -= 1.0;
  if (untold_ > 0) {
    print(std::to_string(untold_) + " lines left out");
    untold_ = 0;
  }
  return true;
}

/// The place of this kind of line; where it is a new one, that of the one silent longest.
Log::Said& Log::remembered(const std::string& line, MonotonicTime now) {
  const std::string kind = kind_of(line);
  Said* place = &said_[0];
  for (Said& said : said_) {
    if (said.kind == kind) {
      return said;
    }
    if (said.since < place->since) {
      place = &said;
    }
  }
  tell_repeat(*place, now);
  *place = {kind, line, now, 0, 0};
  return *place;
}

void Log::tell_repeat(Said& said, MonotonicTime now) {
  if (said.untold == 0) {
    return;
  }
  const auto within = std::chrono::duration_cast<std::chrono::seconds>(now - said.since);
  if (allowed(now)) {
    print(said.line + " (said " + std::to_string(said.times) + " times in " +
          std::to_string(within.count()) + " s)");
  } else {
    ++untold_;
  }
  said.untold = 0;
}

void Log::tell_repeats(MonotonicTime now) {
  const std::lock_guard lock(mutex_);
  for (Said& said : said_) {
    if (!said.kind.empty() && now - said.since >= kTimeOfAKind) {
      tell_repeat(said, now);
      said = {};
    }
  }
}

void Log::say_at(const std::string& line, MonotonicTime now) {
  tell_repeats(now);
  const std::lock_guard lock(mutex_);
  const std::string text = one_line(line);
  Said& said = remembered(text, now);
  ++said.times;
  said.line = text;
  if (said.times > kMostOfAKind) {
    ++said.untold;
    ++left_out_;
  } else if (allowed(now)) {
    print(text);
  } else {
    ++untold_;
    ++left_out_;
  }
}

std::int64_t Log::left_out() const {
  const std::lock_guard lock(mutex_);
  return left_out_;
}

}  // namespace tubesight::board
