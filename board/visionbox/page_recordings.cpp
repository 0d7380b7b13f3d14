#include "board/visionbox/page_recordings.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>

#include "drivers/recording/recording_folder.h"

namespace tubesight::board {
namespace {

constexpr std::string_view kBegin = "box-";
constexpr std::size_t kMostListed = 1000;

/// box-NNNNNN-YYYYMMDDTHHMMSSZ-REASON.ENDING
bool has_ending(std::string_view name) {
  return std::ranges::any_of(drivers::RecordingFolder::kEndings,
                             [&](std::string_view ending) { return name.ends_with(ending); });
}

/// The words between the hyphens of a name.
struct NameParts {
  std::string at;
  std::string reason;
};

NameParts parts_of(const std::string& name) {
  const std::size_t number = name.find('-', kBegin.size());
  const std::size_t at = number == std::string::npos ? number : name.find('-', number + 1);
  if (at == std::string::npos) {
    return {};
  }
  return {name.substr(number + 1, at - number - 1),
          name.substr(at + 1, name.find('.', at) - at - 1)};
}

}  // namespace

bool is_recording_name(std::string_view name) {
  return name.size() < 100 && name.starts_with(kBegin) && has_ending(name) &&
         name.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-.") ==
             std::string_view::npos;
}

Json list_recordings(const std::string& folder) {
  Json all = Json::array();
  if (folder.empty()) {
    return all;
  }
  std::vector<std::filesystem::directory_entry> entries;
  std::error_code problem;
  for (const auto& entry : std::filesystem::directory_iterator(folder, problem)) {
    if (is_recording_name(entry.path().filename().string()) && entries.size() < kMostListed) {
      entries.push_back(entry);
    }
  }
  std::sort(entries.begin(), entries.end());
  for (const auto& entry : entries) {
    const std::string name = entry.path().filename().string();
    const NameParts parts = parts_of(name);
    const std::uintmax_t bytes = entry.file_size(problem);
    all.push_back({{"name", name},
                   {"bytes", problem ? 0 : bytes},
                   {"at", parts.at},
                   {"reason", parts.reason}});
  }
  return all;
}

std::optional<drivers::PageAnswer> download_recording(const std::string& folder,
                                                      const std::string& name) {
  if (folder.empty() || !is_recording_name(name)) {
    return {};
  }
  const std::string path = (std::filesystem::path(folder) / name).string();
  drivers::PageAnswer answer;
  answer.file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (answer.file < 0) {
    return {};
  }
  answer.type = "application/octet-stream";
  answer.headers.emplace_back("Content-Disposition", "attachment; filename=\"" + name + "\"");
  return answer;
}

}  // namespace tubesight::board
