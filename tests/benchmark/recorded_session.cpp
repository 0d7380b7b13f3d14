#include "tests/benchmark/recorded_session.h"

#include <chrono>
#include <cstddef>
#include <filesystem>

#include "drivers/replay/replay_frame_grabber.h"
#include "drivers/settings/session_settings.h"

namespace tubesight::tests {
namespace {

std::vector<std::uint8_t> copy_of(const core::ImageView& frame) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(static_cast<std::size_t>(frame.width_px) *
                 static_cast<std::size_t>(frame.height_px));
  for (std::int32_t v = 0; v < frame.height_px; ++v) {
    pixels.insert(pixels.end(), frame.line(v), frame.line(v) + frame.width_px);
  }
  return pixels;
}

}  // namespace

bool RecordedSession::load(const std::string& folder, drivers::Messages& messages) {
  const auto file = std::make_unique<drivers::SessionFile>();
  if (!drivers::load_session_settings(folder + "/session.toml", drivers::kReplayNeeds, *file,
                                      messages)) {
    return false;
  }
  settings_ = std::make_unique<core::SessionSettings>(file->settings);
  std::string recording = folder + "/recording.y4m.xz";
  if (!std::filesystem::exists(recording)) {
    recording = folder + "/recording.y4m";
  }
  drivers::ReplayFrameGrabber grabber(settings_->camera, recording);
  if (!grabber.start()) {
    messages = grabber.messages();
    return false;
  }
  while (auto lease = grabber.grab_for(std::chrono::milliseconds(0))) {
    const core::ImageView frame = grabber.frame();
    const std::int64_t number = grabber.field_number();
    if (numbers_.empty() || numbers_.back() / 2 != number / 2) {
      frames_.push_back(copy_of(frame));
    }
    core::Field field = lease->field();
    field.pixels = core::field_of(
        {frames_.back().data(), frame.width_px, frame.height_px, frame.width_px}, field.parity);
    fields_.push_back(field);
    numbers_.push_back(number);
  }
  messages = grabber.messages();
  return messages.empty() && fields_.size() > 1;
}

}  // namespace tubesight::tests
