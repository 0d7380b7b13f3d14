#include "board/visionbox/v4l2_camera.h"

namespace tubesight::board {

std::string V4l2Camera::message() const {
  return grabber_.messages().empty() ? std::string() : grabber_.messages().front();
}

CameraStatus V4l2Camera::status() const { return status_of(grabber_.report()); }

CameraStatus status_of(const drivers::CameraReport& report) {
  const drivers::CameraCounters& counters = report.counters;
  CameraStatus status;
  status.well = report.trouble == drivers::CameraTrouble::kNone;
  status.words = words_of(report.trouble);
  status.counts = report.counts;
  status.stamps = report.stamps;
  status.counters = {{"buffers", counters.buffers},
                     {"lost_fields", counters.lost_fields},
                     {"flagged", counters.flagged},
                     {"cut_short", counters.cut_short},
                     {"unwritten", counters.unwritten},
                     {"without_signal", counters.without_signal},
                     {"other_standard", counters.other_standard},
                     {"noise", counters.noise},
                     {"blank", counters.blank},
                     {"black", counters.black},
                     {"wrong_stamps", counters.wrong_stamps},
                     {"without_stamp", counters.without_stamp},
                     {"counter_back", counters.counter_back},
                     {"counter_repeated", counters.counter_repeated},
                     {"odd_order", counters.odd_order},
                     {"queue_errors", counters.queue_errors},
                     {"dequeue_errors", counters.dequeue_errors},
                     {"idle_wakes", counters.idle_wakes},
                     {"source_changes", counters.source_changes},
                     {"silences", counters.silences},
                     {"disconnects", counters.disconnects}};
  return status;
}

}  // namespace tubesight::board
