#include "board/visionbox/vision_box.h"

#include <random>
#include <utility>

#include "board/box/version.h"
#include "board/visionbox/camera_world.h"
#include "board/visionbox/journal_store.h"
#include "board/visionbox/link_identity.h"
#include "board/visionbox/played_world.h"
#include "core/base/assert.h"

namespace tubesight::board {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

std::unique_ptr<WatchedWorld> make_world(const BoxSettings& settings, hal::OperatorStation& station,
                                         const VisionBox::Tell& tell) {
  if (is_camera(settings.source.kind)) {
    return std::make_unique<CameraWorld>(settings, station, tell);
  }
  return std::make_unique<PlayedWorld>(settings, station, settings.link.kind == LinkKind::kNone,
                                       tell);
}

/// Null: there is none.
std::unique_ptr<KeptLink> make_link(const BoxSettings& settings, const hal::Clock& clock,
                                    const ZoneDesk* zones, const VisionBox::Tell& tell) {
  if (settings.link.kind == LinkKind::kNone) {
    return nullptr;
  }
  // A claim is stamped when this thread sees it: late on a busy machine without a rank.
  const KeptLink::Rank rank =
      settings.real_time.priority > 0 ? KeptLink::Rank::kBeforeOthers : KeptLink::Rank::kLikeOthers;
  drivers::LinkIdentity identity = link_identity(settings.told());
  identity.zones = zones;
  return std::make_unique<KeptLink>(settings.link.modbus, identity, clock, rank, tell);
}

/// Null: nothing is recorded.
std::unique_ptr<EventRecorder> make_recorder(const BoxSettings& settings) {
  if (!settings.record.wanted()) {
    return nullptr;
  }
  auto recorder = std::make_unique<EventRecorder>();
  const auto configured =
      recorder->configure(settings.record.recorder, settings.told().camera,
                          core::session::Session<core::FixedPoint>::state_bytes());
  TUBESIGHT_ASSERT(configured);  // the settings were checked for it
  return recorder;
}

/// Another pattern at each start: what another box has recorded, or this one before, is not taken
/// for a live picture.
core::lighting::LampPolicy lamp_policy(const LampSettings& lamp) {
  core::lighting::LampPolicy policy;
  policy.follows_picture = lamp.automatic;
  policy.pattern = lamp.pattern;
  policy.seed = std::random_device()();
  return policy;
}

std::unique_ptr<RecordingWriter> make_writer(EventRecorder* recorder, const BoxSettings& settings,
                                             const std::string& origin,
                                             const VisionBox::Tell& tell) {
  if (recorder == nullptr) {
    return nullptr;
  }
  return std::make_unique<RecordingWriter>(*recorder, settings.record, settings.told(), origin,
                                           tell);
}

/// Null: no pairs are written.
std::unique_ptr<PairsWriter> make_pairs_writer(PairDesk& desk, const BoxSettings& settings,
                                               const VisionBox::Tell& tell) {
  return settings.pairs.wanted() ? std::make_unique<PairsWriter>(desk, settings.pairs.file, tell)
                                 : nullptr;
}

hal::OperatorStation& station_of(JoinedStation* joined, drivers::SocketStation& alone) {
  return joined != nullptr ? static_cast<hal::OperatorStation&>(*joined) : alone;
}

/// Null: no journal is kept.
std::unique_ptr<JournalDesk> make_journal_desk(const BoxSettings& settings) {
  const core::CameraSettings& camera = settings.told().camera;
  return settings.journal.wanted()
             ? std::make_unique<JournalDesk>(camera.width_px, camera.height_px)
             : nullptr;
}

std::unique_ptr<JournalWriter> make_journal_writer(JournalDesk* desk, const BoxSettings& settings,
                                                   const hal::Clock& fields,
                                                   const VisionBox::Tell& tell) {
  if (desk == nullptr) {
    return nullptr;
  }
  const drivers::SessionFile& session = settings.session;
  return std::make_unique<JournalWriter>(
      *desk, fields, settings.journal.file,
      JournalFrame{kernel_boot_id(), std::string(program_version()), session.camera_quality.id,
                   session.tool_quality.id, session.base_quality.id,
                   settings_digest(settings.page.file)},
      make_journal_parts(settings.journal), tell);
}

}  // namespace

VisionBox::VisionBox(const BoxSettings& settings, Tell tell, const std::string& origin)
    : settings_(&settings),
      tell_(std::move(tell)),
      page_(settings.page.wanted ? std::make_unique<PagePorts>(settings.told().camera) : nullptr),
      stations_(page_ == nullptr ? nullptr
                                 : std::make_unique<JoinedStation>(socket_station_, page_->station,
                                                                   PageDesk::kFirstId)),
      world_(make_world(settings, station_of(stations_.get(), socket_station_), tell_)),
      source_(world_->source()),
      zones_(settings.zones.wanted()
                 ? std::make_unique<ZoneDesk>(settings.zones.points, settings.told().tubesheet)
                 : nullptr),
      kept_link_(make_link(settings, source_.clock(), zones_.get(), tell_)),
      silent_link_(settings.lamp.silent_link),
      pose_handover_(poses_, settings.told().camera.width_px, settings.told().camera.height_px),
      pairs_writer_(make_pairs_writer(pair_desk_, settings, tell_)),
      journal_desk_(make_journal_desk(settings)),
      journal_writer_(make_journal_writer(journal_desk_.get(), settings, source_.clock(), tell_)),
      recorder_(make_recorder(settings)),
      writer_(make_writer(recorder_.get(), settings, origin, tell_)),
      loop_(session_, ports(),
            {&pose_handover_, nullptr, page_ == nullptr ? nullptr : &page_->marks, false,
             recorder_.get(), lamp_policy(settings.lamp),
             pairs_writer_ == nullptr ? nullptr : &pair_desk_,
             page_ == nullptr ? nullptr : &page_->tap, journal_desk_.get()}),
      tracking_(loop_, source_, {kept_link_.get(), world_->lamp(), pairs_writer_.get()},
                settings.real_time) {}

/// A robot that is there takes the scripted one's place.
BoxPorts VisionBox::ports() {
  hal::RobotLink* link = kept_link_.get();
  if (link == nullptr) {
    link = world_->scripted_robot();
  }
  return {&source_, &source_.clock(),   world_->dimmer(),
          link,     &world_->station(), world_->lamp_history()};
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
    tell_("the lamp cannot be started");
    source_.stop();
    started_ = false;
    return started;
  }
  pose_worker_.start();
  if (zones_ != nullptr) {
    zones_->start();
  }
  if (pairs_writer_ != nullptr) {
    pairs_writer_->start();
  }
  if (journal_writer_ != nullptr) {
    journal_writer_->start();
  }
  if (writer_ != nullptr) {
    writer_->start();
  }
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
  if (pairs_writer_ != nullptr) {
    pairs_writer_->stop();
  }
  if (journal_writer_ != nullptr) {
    journal_writer_->stop();
  }
  if (writer_ != nullptr) {
    recorder_->flush();
    writer_->stop();
  }
  if (zones_ != nullptr) {
    zones_->stop();  // may take seconds, while nothing is lost any more
  }
}

void VisionBox::look_after() {
  if (kept_link_ != nullptr) {
    kept_link_->look_after(monotonic_now());
  }
  if (kept_link_ != nullptr && world_->lamp() != nullptr) {
    // Where it cannot be known whether the box tracks, the lamp stays as it is.
    TrackingStatus status;
    if (tracking_.status(status)) {
      const bool tracking = status.sighting.state == core::TrackState::kTracking ||
                            status.sighting.state == core::TrackState::kDegraded;
      world_->lamp()->set_most(silent_link_.most_permille(kept_link_->report().counters.requests,
                                                          tracking, monotonic_now()));
    }
  }
}

PageDesk::Box VisionBox::page_box() {
  PageDesk::Box box;
  box.settings = settings_;
  box.station = &page_->station;
  box.tap = &page_->tap;
  box.marks = &page_->marks;
  box.clock = &source_.clock();
  box.journal = journal_writer_.get();
  if (records()) {
    box.request_recording = [this] { return request_recording(); };
    box.record_answer = [this](std::uint32_t number) { return record_answer(number); };
  }
  return box;
}

Beats VisionBox::beats() const {
  const LampKeeper* const lamp = std::as_const(*world_).lamp();
  return {tracking_.turns(), kept_link_ == nullptr ? -1 : kept_link_->rounds(),
          lamp == nullptr ? -1 : lamp->rounds(), -1};
}

void VisionBox::tell_robot(const drivers::LinkSelfTest& self_test,
                           const drivers::LinkJournal& journal) {
  if (kept_link_ != nullptr) {
    kept_link_->set_self_test(self_test);
    kept_link_->set_journal(journal);
  }
}

BoxReport VisionBox::report() const {
  BoxReport report;
  report.turned = tracking_.status(report.tracking);
  report.up = monotonic_now() - started_at_;
  report.source_kind = name_of(settings_->source.kind);
  report.camera = world_->camera();
  if (world_->lamp() != nullptr) {
    report.lamp = world_->lamp()->report();
  }
  report.source = source_.state();
  report.span = source_.span();
  report.passes = source_.passes();
  report.failures = source_.failures();
  report.made_late = source_.made_late();
  report.link_kind = kept_link_ == nullptr ? "none" : "modbus";
  report.link = kept_link_ == nullptr ? LinkReport{} : kept_link_->report();
  report.recorder = writer_ == nullptr ? RecorderReport{} : writer_->report();
  report.pairs = pairs_writer_ == nullptr ? PairsReport{} : pairs_writer_->report();
  report.journal = journal_writer_ == nullptr ? JournalReport{} : journal_writer_->report();
  if (zones_ != nullptr) {
    report.zones = zones_->places();
    report.zones_known = zones_->ready();
  }
  report.pattern_wanted = settings_->lamp.pattern;
  report.priority = settings_->real_time.priority;
  report.lock_wanted = settings_->real_time.lock_memory;
  report.memory_locked = memory_locked_;
  report.deadline_ms = settings_->real_time.deadline_ms;
  report.poses_passed_over = pose_handover_.passed_over();
  return report;
}

}  // namespace tubesight::board
