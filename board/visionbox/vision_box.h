#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "board/box/box_loop.h"
#include "board/box/event_recorder.h"
#include "board/box/journal_desk.h"
#include "board/box/pair_desk.h"
#include "board/box/picture_tap.h"
#include "board/box/pose_handover.h"
#include "board/box/pose_service.h"
#include "board/visionbox/box_report.h"
#include "board/visionbox/box_settings.h"
#include "board/visionbox/joined_station.h"
#include "board/visionbox/journal_writer.h"
#include "board/visionbox/kept_link.h"
#include "board/visionbox/life_signs.h"
#include "board/visionbox/page_desk.h"
#include "board/visionbox/pairs_writer.h"
#include "board/visionbox/pose_worker.h"
#include "board/visionbox/recording_writer.h"
#include "board/visionbox/silent_link.h"
#include "board/visionbox/tracking_thread.h"
#include "board/visionbox/watched_world.h"
#include "board/visionbox/zone_desk.h"
#include "core/base/result.h"
#include "core/session/session.h"
#include "drivers/control/socket_station.h"

namespace tubesight::board {

/// All objects of the box and how they hang together; the only place that knows.
///
/// Which threads there are: the tracking thread (real time), that of the source, that of poses,
/// those of recordings, of pairs and of the
/// journal, and the caller's. What crosses between them does so through
/// queues and snapshots that nobody waits for. Some 4 MB, and the recorder's memory: heap.
class VisionBox {
 public:
  using Tell = std::function<void(const std::string&)>;

  /// `settings` were read by load_box_settings() and outlive the box; `tell` takes lines for a
  /// person, on several threads. `origin` stands in each recording: who made it, and when.
  VisionBox(const BoxSettings& settings, Tell tell, const std::string& origin = {});
  VisionBox(const VisionBox&) = delete;
  VisionBox& operator=(const VisionBox&) = delete;
  ~VisionBox() { stop(); }

  /// Starts everything; the box then waits for a start. A link that cannot be opened is told and
  /// tried again. Errors: kNotReady started already, and those of the lamp, told.
  [[nodiscard]] core::Result<void> start();

  /// The same but for the tracking thread: the caller makes the turns of tracking() himself.
  [[nodiscard]] core::Result<void> start_without_tracking();

  /// Judges no field, and so vouches for nothing, whatever comes. Before start().
  void judge_nothing() { tracking_.judge_nothing(); }

  /// What the robot reads of the box's test of itself and of its journal. Of the thread that starts
  /// the box.
  void tell_robot(const drivers::LinkSelfTest& self_test, const drivers::LinkJournal& journal);

  /// Stops everything; the lamp goes dark.
  void stop();

  /// Does what is left to do beside the tracking: opens a link that could not be opened, and lets
  /// the lamp rest when the robot is silent. To be called now and then, on the thread that started
  /// the box.
  void look_after();

  [[nodiscard]] BoxReport report() const;

  /// How often each part has come round; the desk is the caller's. Any thread.
  [[nodiscard]] Beats beats() const;

  /// Asks for a recording of what just was; its number, for record_answer(). Any thread.
  [[nodiscard]] std::uint32_t request_recording() { return recorder_->request(); }
  [[nodiscard]] RecordAnswer record_answer(std::uint32_t number) const {
    return writer_->answer(number);
  }
  /// Whether there is a recorder; the two above need one.
  [[nodiscard]] bool records() const { return recorder_ != nullptr; }

  /// Null: none is kept.
  [[nodiscard]] JournalWriter* journal() { return journal_writer_.get(); }

  [[nodiscard]] drivers::SocketStation& station() { return socket_station_; }
  /// What the page has to do with the box; there is a page.
  [[nodiscard]] PageDesk::Box page_box();
  [[nodiscard]] TrackingThread& tracking() { return tracking_; }
  [[nodiscard]] const TrackingThread::Loop& loop() const { return loop_; }

 private:
  [[nodiscard]] BoxPorts ports();

  const BoxSettings* settings_;
  Tell tell_;
  bool started_ = false;
  bool memory_locked_ = false;
  MonotonicTime started_at_{0};

  /// What the page sees of the tracking, and says to it.
  struct PagePorts {
    explicit PagePorts(const core::CameraSettings& camera)
        : tap(camera.width_px, camera.height_px) {}
    drivers::SocketStation station;
    PictureTap tap;
    core::Snapshot<OverlaySnapshot> marks;
  };

  drivers::SocketStation socket_station_;
  std::unique_ptr<PagePorts> page_;  ///< null: there is no page
  std::unique_ptr<JoinedStation> stations_;
  std::unique_ptr<WatchedWorld> world_;
  FieldSource& source_;
  std::unique_ptr<ZoneDesk> zones_;      ///< null: no corrections
  std::unique_ptr<KeptLink> kept_link_;  ///< null: the script's robot, if any
  SilentLink silent_link_;

  core::session::Session<core::FixedPoint> session_;
  PoseService poses_;
  PoseHandover pose_handover_;
  PoseWorker pose_worker_{pose_handover_};

  PairDesk pair_desk_;
  std::unique_ptr<PairsWriter> pairs_writer_;  ///< null: no pairs are written

  std::unique_ptr<JournalDesk> journal_desk_;      ///< null: no journal is kept
  std::unique_ptr<JournalWriter> journal_writer_;  ///< null: the same

  std::unique_ptr<EventRecorder> recorder_;  ///< null: nothing is recorded
  std::unique_ptr<RecordingWriter> writer_;

  TrackingThread::Loop loop_;
  TrackingThread tracking_;
};

}  // namespace tubesight::board
