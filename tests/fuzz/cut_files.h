#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "drivers/settings/text_files.h"

namespace tubesight::fuzz {

/// Files cut out of one text at the lines "#---": `first`, then 1.toml, 2.toml ...
class CutFiles final : public drivers::TextFiles {
 public:
  CutFiles(std::string_view text, std::string first) : first_(std::move(first)) {
    constexpr std::string_view kCut = "#---\n";
    while (true) {
      const std::size_t end = text.find(kCut);
      parts_.push_back(text.substr(0, end));
      if (end == std::string_view::npos) {
        break;
      }
      text.remove_prefix(end + kCut.size());
    }
  }

  core::Result<void> read(const std::string& path, std::string& text,
                          std::string& message) override {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (path == (i == 0 ? first_ : std::to_string(i) + ".toml")) {
        text = parts_[i];
        return {};
      }
    }
    message = "No such file or directory";
    return core::Unexpected(core::Error::kIo);
  }

 private:
  std::string first_;
  std::vector<std::string_view> parts_;
};

}  // namespace tubesight::fuzz
