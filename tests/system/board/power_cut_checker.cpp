// What a disk has after a power cut, by the product's own readers.
//
// Usage: power_cut_checker < FOLDERS     a folder a line; answers each with a line of its own:
//        zones 12, zones.bak 11, base 7, base.bak 6, pairs 5, recordings 3 to 9
//        separated by tabs, with "none" for a file that is not there and "bad: WHY" for one that is
//        no whole version.
//
// As a box that starts it removes the remains of recordings first.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/files/csv_reader.h"
#include "drivers/files/pairs_file.h"
#include "drivers/files/zones_file.h"
#include "drivers/recording/file_recording_store.h"
#include "drivers/replay/replay_events.h"
#include "drivers/replay/replay_frame_grabber.h"
#include "drivers/settings/base_settings.h"
#include "drivers/settings/session_settings.h"
#include "drivers/settings/text_files.h"

namespace tubesight::tests {
namespace {

constexpr std::int64_t kRecordings_mb = 1000;  // none is removed for want of room

std::string bad(const std::string& why) { return "bad: " + why; }
std::string bad(const drivers::Messages& why) { return bad(why.empty() ? "?" : why.front()); }

/// The text of a file that is there.
std::string text_of(const std::string& path) {
  std::string text;
  std::string why;
  return drivers::DiskFiles().read(path, text, why) ? text : why;
}

/// Corrections: the version is the number of rows.
std::string zones_at(const std::string& path) {
  constexpr std::size_t kMost = 256;
  std::vector<drivers::ZoneRow> rows;
  drivers::Messages messages;
  return drivers::read_zone_rows(text_of(path), "zones", kMost, rows, messages)
             ? std::to_string(rows.size())
             : bad(messages);
}

/// A base: the version is its depth below 1 m, in mm. The file's quality goes behind the base, so
/// that a file without it is none that the program wrote.
std::string base_at(const std::string& path) {
  drivers::BaseSettings base;
  drivers::Messages messages;
  if (!drivers::load_base_settings(path, base, messages)) {
    return bad(messages);
  }
  if (text_of(path).find("\nverdict = \"6 pairs") == std::string::npos) {
    return bad("no quality behind the base");
  }
  constexpr double kFirst_mm = -1000.0;
  return std::to_string(std::lround(kFirst_mm - base.position_mm[2]));
}

/// Pairs: rows named p1, p2 ... without a gap.
std::string pairs_at(const std::string& path) {
  drivers::Messages messages;
  const std::string text = text_of(path);
  drivers::CsvReader reader(text, "pairs");
  if (const std::string why = drivers::why_no_pairs(path); !why.empty()) {
    return bad(why);
  }
  static_cast<void>(reader.read_header(drivers::pair_columns(), messages));
  std::int64_t rows = 0;
  while (reader.next(messages)) {
    if (reader.cells()[0] != "p" + std::to_string(++rows)) {
      return bad("row " + std::to_string(rows) + " is not p" + std::to_string(rows));
    }
  }
  return messages.empty() ? std::to_string(rows) : bad(messages);
}

/// Why a recording is not what `replay` takes, whole; empty: it is.
std::string why_not_whole(const std::string& picture) {
  const std::string name = picture.substr(0, picture.size() - std::string_view(".y4m").size());
  drivers::Messages messages;
  const auto session = std::make_unique<drivers::SessionFile>();
  if (!drivers::load_session_settings(name + ".session.toml", drivers::kReplayNeeds, *session,
                                      messages)) {
    return messages.front();
  }
  drivers::ReplayEvents events;
  if (!events.load_beside(picture, messages)) {
    return messages.front();
  }
  std::error_code error;
  if (std::filesystem::file_size(name + ".state", error) == 0 || error) {
    return name + ".state: is missing or empty";
  }
  drivers::ReplayFrameGrabber grabber(session->settings.camera, picture);
  grabber.follow_rows();
  core::Error end = core::Error::kEndOfData;
  if (const auto started = grabber.start(); !started) {
    end = started.error();
  } else {
    while (true) {
      const auto lease = grabber.grab_for(std::chrono::milliseconds(0));
      if (!lease) {
        end = lease.error();
        break;
      }
    }
  }
  return end == core::Error::kEndOfData
             ? ""
             : (grabber.messages().empty() ? picture : grabber.messages().front());
}

/// Recordings: their first and last number; each is whole.
std::string recordings_in(const std::string& folder) {
  drivers::FileRecordingStore store(folder, kRecordings_mb, "", [] { return std::int64_t{0}; });
  if (!store.open()) {
    return bad(store.message());
  }
  std::int64_t first = 0;
  std::int64_t last = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const std::string name = file.path().filename().string();
    if (!name.starts_with("box-")) {
      continue;
    }
    if (name.ends_with(".part")) {
      return bad(name + ": remains");
    }
    if (!name.ends_with(".y4m")) {
      continue;
    }
    if (const std::string why = why_not_whole(file.path().string()); !why.empty()) {
      return bad(why);
    }
    const std::int64_t number = std::stoll(name.substr(4));
    first = first == 0 ? number : std::min(first, number);
    last = std::max(last, number);
  }
  return last == 0 ? "none" : std::to_string(first) + " to " + std::to_string(last);
}

std::string line_of(const std::string& folder) {
  using Reader = std::string (*)(const std::string& path);
  struct Kept {
    const char* name;
    const char* file;
    Reader read;
  };
  constexpr Kept kKept[] = {{"zones", "zones.csv", zones_at},
                            {"zones.bak", "zones.csv.bak", zones_at},
                            {"base", "base.toml", base_at},
                            {"base.bak", "base.toml.bak", base_at},
                            {"pairs", "pairs.csv", pairs_at}};
  std::string line;
  for (const Kept& kept : kKept) {
    const std::string path = folder + "/" + kept.file;
    line += std::string(kept.name) + " " +
            (std::filesystem::exists(path) ? kept.read(path) : "none") + "\t";
  }
  return line + "recordings " + recordings_in(folder);
}

}  // namespace
}  // namespace tubesight::tests

int main() {
  for (std::string folder; std::getline(std::cin, folder);) {
    std::string line = tubesight::tests::line_of(folder);
    std::replace(line.begin(), line.end(), '\n', ' ');
    std::cout << line << std::endl;
  }
  return 0;
}
