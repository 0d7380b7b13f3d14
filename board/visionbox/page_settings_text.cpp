#include "board/visionbox/page_settings_text.h"

#include <memory>

#include "board/visionbox/box_settings.h"
#include "board/visionbox/page_access.h"
#include "drivers/files/atomic_file.h"
#include "drivers/settings/text_files.h"

namespace tubesight::board {
namespace {

using drivers::PageAnswer;

/// The disk, with another text in the place of one file.
class EditedFiles final : public drivers::TextFiles {
 public:
  EditedFiles(const std::string& path, const std::string& text) : path_(path), text_(text) {}

  [[nodiscard]] core::Result<void> read(const std::string& path, std::string& text,
                                        std::string& message) override {
    if (path != path_) {
      return disk_.read(path, text, message);
    }
    text = text_;
    return {};
  }

 private:
  const std::string& path_;
  const std::string& text_;
  drivers::DiskFiles disk_;
};

drivers::Messages mistakes(const std::string& file, const std::string& text) {
  EditedFiles files(file, text);
  const auto box = std::make_unique<BoxSettings>();
  drivers::Messages messages;
  static_cast<void>(load_box_settings(files, file, *box, messages));
  return messages;
}

std::string write(const std::string& path, const std::string& text) {
  drivers::AtomicFile file;
  const bool written = file.open(path) && file.write(text) && file.commit_to_disk();
  return written ? std::string() : file.message();
}

}  // namespace

PageAnswer settings_answer(const std::string& file, bool download) {
  drivers::DiskFiles disk;
  std::string text;
  std::string message;
  if (!disk.read(file, text, message)) {
    return error_answer(500, file + ": cannot be read: " + message);
  }
  if (!download) {
    return json_answer({{"text", text}, {"path", file}, {"files", {file}}});
  }
  PageAnswer answer;
  answer.type = "application/toml";
  answer.body = std::make_shared<const std::string>(text);
  answer.headers.emplace_back("Content-Disposition", "attachment; filename=\"box.toml\"");
  return answer;
}

PageAnswer check_settings(const std::string& file, const std::string& text) {
  return json_answer({{"messages", mistakes(file, text)}});
}

PageAnswer save_settings(const std::string& file, const std::string& text) {
  const drivers::Messages messages = mistakes(file, text);
  if (!messages.empty()) {
    return json_answer({{"messages", messages}, {"saved", false}});
  }
  drivers::DiskFiles disk;
  std::string before;
  std::string message;
  const std::string backup = file + ".backup";
  if (!disk.read(file, before, message)) {
    return error_answer(500, file + ": cannot be read: " + message);
  }
  std::string trouble = write(backup, before);
  if (trouble.empty()) {
    trouble = write(file, text);
  }
  if (!trouble.empty()) {
    return json_answer({{"messages", {trouble}}, {"saved", false}});
  }
  return json_answer(
      {{"messages", Json::array()}, {"saved", true}, {"backup", backup}, {"when", "restart"}});
}

}  // namespace tubesight::board
