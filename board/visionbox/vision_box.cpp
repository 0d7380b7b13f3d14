#include "board/visionbox/vision_box.h"

#include "board/visionbox/replay_player.h"
#include "board/visionbox/simulated_player.h"

namespace tubesight::board {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

std::unique_ptr<FieldPlayer> make_player(const BoxSettings& settings) {
  if (settings.source.kind == SourceKind::kSimulated) {
    return std::make_unique<SimulatedPlayer>(settings.scenario.scenario, settings.source.script);
  }
  return std::make_unique<ReplayPlayer>(settings.told(), settings.source.recording,
                                        settings.source.script);
}

}  // namespace

VisionBox::VisionBox(const BoxSettings& settings, Tell tell)
    : settings_(&settings),
      tell_(std::move(tell)),
      player_(make_player(settings)),
      source_(*player_, source_settings(), tell_),
      pose_handover_(poses_, settings.told().camera.width_px, settings.told().camera.height_px),
      loop_(session_, ports(), {&pose_handover_, nullptr, nullptr, false}),
      tracking_(loop_, source_, settings.real_time) {}

PlayedSourceSettings VisionBox::source_settings() const {
  const core::CameraSettings& camera = settings_->told().camera;
  PlayedSourceSettings source;
  source.loop = settings_->source.loop;
  source.width_px = camera.width_px;
  source.height_px = camera.height_px;
  return source;
}

/// A link of another kind than none takes the scripted one's place here.
BoxPorts VisionBox::ports() {
  return {&source_, &source_.clock(), player_->has_lamp() ? &dimmer_ : nullptr, &scripted_link_,
          &station_};
}

Result<void> VisionBox::start_without_tracking() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  const core::SessionSettings& session = settings_->told();
  TUBESIGHT_TRY(session_.configure(session));
  TUBESIGHT_TRY(poses_.configure(session));
  started_ = true;
  started_at_ = monotonic_now();
  TUBESIGHT_TRY(source_.start());
  if (const auto started = loop_.start(); !started) {
    tell_("lamp or link cannot be started");
    source_.stop();
    started_ = false;
    return started;
  }
  pose_worker_.start();
  return {};
}

Result<void> VisionBox::start() {
  if (settings_->real_time.lock_memory) {
    const std::string why = lock_all_memory();
    memory_locked_ = why.empty();
    if (!memory_locked_) {
      tell_("memory is not locked: " + why);
    }
  }
  TUBESIGHT_TRY(start_without_tracking());
  if (const std::string why = tracking_.start(); !why.empty()) {
    tell_("the tracking thread has no real-time priority: " + why);
  }
  return {};
}

void VisionBox::stop() {
  if (!started_) {
    return;
  }
  started_ = false;
  tracking_.stop();
  pose_worker_.stop();
  loop_.stop();
  source_.stop();
}

BoxReport VisionBox::report() const {
  BoxReport report;
  report.turned = tracking_.status(report.tracking);
  report.up = monotonic_now() - started_at_;
  report.source_kind = settings_->source.kind == SourceKind::kSimulated ? "simulated" : "replay";
  report.source = source_.state();
  report.span = source_.span();
  report.passes = source_.passes();
  report.failures = source_.failures();
  report.link_kind = "none";
  report.priority = settings_->real_time.priority;
  report.lock_wanted = settings_->real_time.lock_memory;
  report.memory_locked = memory_locked_;
  report.deadline_ms = settings_->real_time.deadline_ms;
  report.poses_passed_over = pose_handover_.passed_over();
  return report;
}

}  // namespace tubesight::board
