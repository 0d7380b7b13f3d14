#include "board/visionbox/boot_count.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "drivers/files/atomic_file.h"

namespace tubesight::board {
namespace {

constexpr std::int64_t kMostCounted = 2'000'000'000;
constexpr std::size_t kLongestId = 64;
constexpr std::size_t kLongestText = 256;  // longer than what is written

struct Kept {
  std::int64_t boot = 0;
  std::int64_t start = 0;
  std::string id;
};

std::string text_of(const Kept& kept) {
  return "boot " + std::to_string(kept.boot) + "\nstart " + std::to_string(kept.start) + "\nid " +
         kept.id + "\n";
}

/// False: there is something else.
bool read_kept(const std::string& text, Kept& kept) {
  std::array<char, kLongestId + 1> id{};
  if (std::sscanf(text.c_str(), "boot %" SCNd64 "\nstart %" SCNd64 "\nid %64s", &kept.boot,
                  &kept.start, id.data()) != 3) {
    return false;
  }
  kept.id = id.data();
  const auto counted = [](std::int64_t number) { return number >= 1 && number < kMostCounted; };
  // What is written reads back the same, so anything else was not written here.
  return counted(kept.boot) && counted(kept.start) && text == text_of(kept);
}

std::string first_word_of(const std::string& path) {
  std::ifstream file(path);
  std::string word;
  file >> word;
  word.resize(std::min(word.size(), kLongestId));
  return word;
}

}  // namespace

std::string BootCount::words() const {
  return known() ? "boot " + std::to_string(boot) + ", start " + std::to_string(start)
                 : "boots are not numbered: " + trouble;
}

std::string kernel_boot_id(const std::string& boot_id_file) { return first_word_of(boot_id_file); }

BootCount count_boot(const std::string& folder, const std::string& boot_id_file) {
  BootCount count;
  if (folder.empty()) {
    count.trouble = "no folder to count them in, expected STATE_DIRECTORY in the environment";
    return count;
  }
  count.wanted = true;
  const std::string id = first_word_of(boot_id_file);
  if (id.empty()) {
    count.trouble = boot_id_file + ": cannot be read";
    return count;
  }
  const std::string path = folder + "/boots";
  Kept kept;
  errno = 0;
  if (std::ifstream file(path, std::ios::binary); file) {
    std::array<char, kLongestText> bytes{};
    file.read(bytes.data(), bytes.size());
    if (!read_kept({bytes.data(), static_cast<std::size_t>(file.gcount())}, kept)) {
      count.trouble = path +
                      ": damaged, expected boot, start and id: remove it, and they are "
                      "numbered from 1 again";
      return count;
    }
  } else if (errno != ENOENT) {
    count.trouble = path + ": cannot be read: " + std::strerror(errno);
    return count;
  }
  if (kept.id == id) {
    ++kept.start;
  } else {
    kept = {kept.boot + 1, 1, id};
  }
  drivers::AtomicFile file;
  if (!file.open(path) || !file.write(text_of(kept)) || !file.commit_to_disk()) {
    count.trouble = file.message();
    return count;
  }
  count.boot = kept.boot;
  count.start = kept.start;
  return count;
}

}  // namespace tubesight::board
