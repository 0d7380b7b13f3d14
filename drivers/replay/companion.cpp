#include "drivers/replay/companion.h"

#include <cstddef>
#include <filesystem>
#include <system_error>

#include "drivers/files/byte_source.h"

namespace tubesight::drivers {
namespace {

constexpr std::size_t kLargestFile = std::size_t{256} << 20;

}  // namespace

std::string companion_path(std::string_view recording, std::string_view suffix) {
  for (const std::string_view ending : {".y4m", ".y4m.xz"}) {
    if (recording.ends_with(ending)) {
      recording.remove_suffix(ending.size());
      break;
    }
  }
  return std::string(recording) + std::string(suffix);
}

core::Result<bool> read_companion(const std::string& path, std::string& text, Messages& messages) {
  std::error_code ignored;
  if (std::filesystem::status(path, ignored).type() == std::filesystem::file_type::not_found) {
    return false;
  }
  std::string why;
  if (const auto read = read_whole_file(path, kLargestFile, text, why); !read) {
    messages.push_back(path + ": cannot be read: " + why);
    return core::Unexpected(read.error());
  }
  return true;
}

}  // namespace tubesight::drivers
