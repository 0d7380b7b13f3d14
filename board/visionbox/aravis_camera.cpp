#include "board/visionbox/aravis_camera.h"

namespace tubesight::board {

std::string AravisCamera::message() const {
  return grabber_.messages().empty() ? std::string() : grabber_.messages().front();
}

CameraStatus AravisCamera::status() const { return status_of(grabber_.report()); }

CameraStatus status_of(const drivers::AravisReport& report) {
  const drivers::AravisCounters& counters = report.counters;
  CameraStatus status;
  status.well = report.trouble == drivers::AravisTrouble::kNone;
  status.words = words_of(report.trouble);
  status.counts = report.counts;
  status.stamps = report.stamps;
  status.counters = {{"buffers", counters.buffers},
                     {"lost_fields", counters.lost_fields},
                     {"incomplete", counters.incomplete},
                     {"noise", counters.noise},
                     {"blank", counters.blank},
                     {"black", counters.black},
                     {"other_size", counters.other_size},
                     {"settling", counters.settling},
                     {"clock_jumps", counters.clock_jumps},
                     {"clock_back", counters.clock_back},
                     {"too_old", counters.too_old},
                     {"without_stamp", counters.without_stamp},
                     {"counter_back", counters.counter_back},
                     {"counter_repeated", counters.counter_repeated},
                     {"underruns", counters.underruns},
                     {"resent_packets", counters.resent_packets},
                     {"missing_packets", counters.missing_packets},
                     {"silences", counters.silences},
                     {"controls_lost", counters.controls_lost}};
  return status;
}

}  // namespace tubesight::board
