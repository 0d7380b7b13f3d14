#include "board/bench/replay/visit_log.h"

namespace tubesight::board {

void VisitLog::add(const core::Sighting& sighting, core::FieldTime span) {
  if (!sighting.aligned) {
    return;
  }
  if (visits_.empty() || visits_.back().tube != sighting.tool ||
      sighting.time - visits_.back().until > kBridged) {
    visits_.push_back({sighting.tool, sighting.time, sighting.time});
  }
  Visit& visit = visits_.back();
  visit.until = sighting.time + span;
  visit.fields += 1;
  visit.offset_sum_um_q8 += sighting.offset_um_q8;
  visit.height_sum_um_q8 += sighting.height_um_q8;
}

}  // namespace tubesight::board
