#include "board/bench/simulate/recording_files.h"

#include <cstdint>
#include <string_view>

#include "board/bench/simulate/truth_rows.h"
#include "drivers/files/recording_rows.h"
#include "drivers/settings/session_text.h"

namespace tubesight::board {
namespace {

using core::Result;
using core::Unexpected;

enum Text : std::uint8_t { kMeta, kEvents, kTruth, kCenters, kSession };

/// Tube-ends are told of every tenth frame and of the last, as in the recordings.
constexpr std::int64_t kCentersEvery = 10;

drivers::Y4mInterlacing interlacing_of(core::Scan scan) {
  switch (scan) {
    case core::Scan::kEvenFirst: return drivers::Y4mInterlacing::kEvenFirst;
    case core::Scan::kOddFirst: return drivers::Y4mInterlacing::kOddFirst;
    case core::Scan::kProgressive: return drivers::Y4mInterlacing::kProgressive;
  }
  return drivers::Y4mInterlacing::kUnstated;
}

}  // namespace

Result<void> RecordingFiles::checked(Result<void> result, const std::string& why) {
  if (!result) {
    message_ = why;
  }
  return result;
}

Result<void> RecordingFiles::open(const std::string& name, const drivers::Scenario& scenario,
                                  const std::string& heading) {
  scenario_ = &scenario;
  frames_ = 0;
  last_slot_.reset();
  start_passed_ = scenario.told.start.tubes.empty();
  slots_.clear();
  const core::CameraSettings& camera = scenario.scene.camera;
  const drivers::Y4mHeader header{camera.width_px,
                                  camera.height_px,
                                  scenario.video.rate_numerator,
                                  scenario.video.rate_denominator,
                                  interlacing_of(camera.scan),
                                  0};
  TUBESIGHT_TRY(
      checked(video_.open(name + kRecordingSuffixes[0], header, drivers::Y4mWriter::Colour::kMono),
              video_.message()));
  const std::array<std::string, 5> beginnings = {
      std::string(drivers::kMetaHeader) + "\n", std::string(drivers::kEventsHeader) + "\n",
      std::string(kTruthHeader) + "\n", std::string(kTrueCentersHeader) + "\n",
      heading + drivers::session_text(scenario.told)};
  for (std::size_t i = 0; i < texts_.size(); ++i) {
    const auto opened = texts_[i].open(name + kRecordingSuffixes[i + 1]);
    TUBESIGHT_TRY(checked(opened, texts_[i].message()));
    const auto written = texts_[i].write(std::string_view(beginnings[i]));
    TUBESIGHT_TRY(checked(written, texts_[i].message()));
  }
  return {};
}

Result<void> RecordingFiles::add(const drivers::SimulatedWorld& world,
                                 const drivers::SimulatedField& field) {
  if (!last_slot_) {
    last_slot_ = world.last_delivered();
  }
  slots_.push_back(field);
  const std::size_t fields_a_frame =
      scenario_->scene.camera.scan == core::Scan::kProgressive ? 1 : 2;
  return slots_.size() == fields_a_frame ? write_frame(world) : Result<void>();
}

Result<void> RecordingFiles::write_frame(const drivers::SimulatedWorld& world) {
  bool all_lost = true;
  for (const drivers::SimulatedField& field : slots_) {
    all_lost = all_lost && field.lost;
  }
  if (all_lost) {
    slots_.clear();
    return {};
  }
  const bool last = slots_.front().slot <= last_slot_ && last_slot_ <= slots_.back().slot;
  const bool centers = frames_ % kCentersEvery == 0 || last;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    add_rows(world, slots_[i], static_cast<std::int32_t>(i), centers);
  }
  slots_.clear();
  ++frames_;
  const auto drawn = video_.write_frame(world.frame());
  TUBESIGHT_TRY(checked(drawn, video_.message()));
  for (std::size_t i = 0; i < texts_.size(); ++i) {
    const auto written = texts_[i].write(std::string_view(rows_[i]));
    TUBESIGHT_TRY(checked(written, texts_[i].message()));
    rows_[i].clear();
  }
  return {};
}

void RecordingFiles::add_rows(const drivers::SimulatedWorld& world,
                              const drivers::SimulatedField& field, std::int32_t index,
                              bool centers) {
  const FieldPlace place{frames_, index};
  const std::int64_t number = 2 * frames_ + index;
  core::Field delivered = field.field;
  delivered.number = number;  // lost frames are not in the recording
  drivers::append_meta_row(rows_[kMeta], delivered);
  for (const core::Event& event : field.events) {
    if (!start_passed_ && core::content_if<core::Start>(event) != nullptr) {
      start_passed_ = true;  // replay makes it of the session's [start]
      continue;
    }
    drivers::append_event_row(rows_[kEvents], number, event);
  }
  const core::CameraSettings& camera = scenario_->scene.camera;
  append_truth_row(rows_[kTruth], place, field, camera,
                   scenario_->told.verification.aligned_within_mm);
  if (centers) {
    drivers::list_tubes_in_view(world.truth(), scenario_->scene, field.truth, field.faults,
                                in_view_);
    append_true_center_rows(rows_[kCenters], place, field, camera, in_view_);
  }
}

Result<void> RecordingFiles::commit() {
  const auto drawn = video_.flush();
  TUBESIGHT_TRY(checked(drawn, video_.message()));
  for (drivers::AtomicFile& text : texts_) {
    const auto flushed = text.flush();
    TUBESIGHT_TRY(checked(flushed, text.message()));
  }
  // The picture last: what replays needs the others beside it.
  for (drivers::AtomicFile& text : texts_) {
    const auto committed = text.commit();
    TUBESIGHT_TRY(checked(committed, text.message()));
  }
  const auto committed = video_.commit();
  return checked(committed, video_.message());
}

}  // namespace tubesight::board
