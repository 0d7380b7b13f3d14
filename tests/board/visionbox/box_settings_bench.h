#pragma once

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "board/visionbox/box_settings.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::board {

class BoxSettingsTest : public ::testing::Test {
 protected:
  BoxSettingsTest() { folder_.write("recording.y4m", "not looked into"); }

  /// A box that includes the shipped session, with this text behind.
  bool load(const std::string& text) {
    messages_.clear();
    folder_.write("box.toml", std::string("include = [\"") + TUBESIGHT_TEST_DATA_DIR +
                                  "/recordings/square_flush/session.toml\"]\n" + text);
    return static_cast<bool>(load_box_settings(folder_.path("box.toml"), *box_, messages_));
  }
  bool told(const std::string& part) const {
    for (const std::string& message : messages_) {
      if (message.find(part) != std::string::npos) {
        return true;
      }
    }
    return false;
  }

  support::TemporaryFolder folder_;
  std::unique_ptr<BoxSettings> box_ = std::make_unique<BoxSettings>();
  drivers::Messages messages_;
};

inline constexpr const char* kSource =
    "[source]\nkind = \"replay\"\nrecording = \"recording.y4m\"\n";
inline constexpr const char* kCamera = "[source]\nkind = \"v4l2\"\ndevice = \"serial:12\"\n";

}  // namespace tubesight::board
