#include "board/bench/output/picture_folder.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <vector>

#include <unistd.h>

#include "drivers/files/commit_together.h"
#include "drivers/files/png_writer.h"
#include "drivers/files/unfinished.h"

namespace tubesight::board {
namespace {

namespace fs = std::filesystem;
using core::Error;
using core::Result;
using core::Unexpected;

std::string picture_name(std::int64_t field) {
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "field-%06lld.png", static_cast<long long>(field));
  return name.data();
}

bool is_picture_name(std::string_view name) {
  constexpr std::string_view kBefore = "field-";
  constexpr std::string_view kAfter = ".png";
  constexpr std::size_t kFewestDigits = 6;
  if (!name.starts_with(kBefore) || !name.ends_with(kAfter) ||
      name.size() < kBefore.size() + kFewestDigits + kAfter.size()) {
    return false;
  }
  name.remove_prefix(kBefore.size());
  name.remove_suffix(kAfter.size());
  return std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// The pictures in a folder; empty and `why` set when it cannot be read.
std::vector<fs::path> list_pictures(const std::string& folder, std::error_code& why) {
  std::vector<fs::path> pictures;
  for (fs::directory_iterator entry(folder, why), end; !why && entry != end; entry.increment(why)) {
    if (is_picture_name(entry->path().filename().string())) {
      pictures.push_back(entry->path());
    }
  }
  return pictures;
}

}  // namespace

PictureFolder::~PictureFolder() {
  std::error_code ignored;
  if (!collecting_.empty()) {
    fs::remove_all(collecting_, ignored);
    drivers::forget_unfinished(collecting_);
  }
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
  if (made_folder_) {
    fs::remove(folder_, ignored);  // only when empty
  }
}

Result<void> PictureFolder::open(const drivers::Y4mHeader&, bool) {
  std::error_code why;
  const bool was_there = fs::is_directory(folder_, why);
  fs::create_directories(folder_, why);
  if (why) {
    return fail("cannot be made a folder", why);
  }
  made_folder_ = !was_there;
  descriptor_ =
      drivers::make_unfinished_folder((fs::path(folder_) / "pictures").string(), collecting_);
  if (descriptor_ < 0) {
    collecting_.clear();
    return fail("cannot be written", {errno, std::generic_category()});
  }
  return {};
}

Result<void> PictureFolder::add(std::int64_t field, const core::RgbImageView& picture) {
  const drivers::CommitAlone into_the_folder;
  std::string message;
  const auto written = drivers::write_png((fs::path(collecting_) / picture_name(field)).string(),
                                          picture, message, drivers::PngGreys::kNear);
  if (!written) {
    const std::scoped_lock lock(message_mutex_);
    message_ = std::move(message);
  }
  return written;
}

Result<void> PictureFolder::commit() {
  std::error_code why;
  for (const fs::path& old : list_pictures(folder_, why)) {
    fs::remove(old, why);
    if (why) {
      return fail("a picture of an earlier replay cannot be removed", why);
    }
  }
  if (!why) {
    for (const fs::path& picture : list_pictures(collecting_, why)) {
      fs::rename(picture, fs::path(folder_) / picture.filename(), why);
      if (why) {
        return fail("a picture cannot be put in its place", why);
      }
    }
  }
  if (why) {
    return fail("cannot be read", why);
  }
  fs::remove(collecting_, why);
  if (why) {
    return fail("cannot be tidied up", why);
  }
  drivers::forget_unfinished(collecting_);
  collecting_.clear();
  made_folder_ = false;
  return {};
}

Result<void> PictureFolder::fail(const char* what, const std::error_code& why) {
  message_ = folder_ + ": " + what + ": " + why.message();
  drivers::CommitTogether::fail_current();
  return Unexpected(Error::kIo);
}

}  // namespace tubesight::board
