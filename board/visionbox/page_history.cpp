#include "board/visionbox/page_history.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "board/visionbox/page_numbers.h"
#include "core/tubesheet/tubesheet_setup.h"

namespace tubesight::board {
void PageHistory::know_sheet(const core::TubesheetSettings& sheet) { sheet_ = sheet; }

void PageHistory::take(const OverlaySnapshot& marks, const Picture& latest) {
  follow(marks.sighting);
  keep(latest);
}

void PageHistory::follow(const core::Sighting& sighting) {
  now_.reset();
  if (!sighting.tool_known) {
    under_.reset();
    return;
  }
  constexpr double kApart_mm = 2.0;
  const auto center = core::tubesheet::center_mm(sheet_, sighting.tool);
  const Place place{center[0] + mm(sighting.displacement_um_q8[0]),
                    center[1] + mm(sighting.displacement_um_q8[1]), seconds(sighting.time)};
  now_ = place;
  if (path_.empty() ||
      std::hypot(place.x_mm - path_.back().x_mm, place.y_mm - path_.back().y_mm) > kApart_mm) {
    path_.push_back(place);
    if (path_.size() > kMostPath) {
      path_.pop_front();
    }
  }
  if (!sighting.aligned) {
    under_.reset();
    return;
  }
  if (Visit* const here = visit(sighting.tool)) {
    here->count += under_ != sighting.tool ? 1 : 0;
    here->last_s = seconds(sighting.time);
  }
  under_ = sighting.tool;
}

PageHistory::Visit* PageHistory::visit(core::TubeAddress tube) {
  const auto found = visits_.find(tube);
  if (found != visits_.end()) {
    return &found->second;
  }
  return visits_.size() < kMostVisits ? &visits_[tube] : nullptr;
}

void PageHistory::keep(const Picture& latest) {
  constexpr double kApart_s = 0.2;
  if (latest == nullptr || (!recent_.empty() && recent_.back() == latest)) {
    return;
  }
  const double at_s = seconds(latest->marks().sighting.time);
  if (std::abs(at_s - kept_at_s_) < kApart_s) {
    return;
  }
  kept_at_s_ = at_s;
  recent_.push_back(latest);
  const std::size_t bytes = static_cast<std::size_t>(latest->picture().width_px) *
                            static_cast<std::size_t>(latest->picture().height_px);
  const std::size_t most = std::clamp<std::size_t>(kMostPictureBytes / bytes, 2, kMostPictures);
  while (recent_.size() > most) {
    recent_.pop_front();
  }
}

std::int64_t PageHistory::take_claim(const core::ClaimReply& claim, double at_s, std::string wall) {
  if (claim.verdict == core::ClaimVerdict::kUnknown) {
    return 0;
  }
  const bool contradicted = claim.verdict == core::ClaimVerdict::kContradicted;
  if (Visit* const here = visit(claim.claimed)) {
    here->told = contradicted ? Told::kContradicted : Told::kVerified;
    here->last_s = at_s;
  }
  if (!contradicted) {
    return 0;
  }
  // A robot says the same again and again: one disagreement until it is acknowledged.
  if (!disagreements_.empty() && !disagreements_.back().acknowledged &&
      disagreements_.back().claim.claimed == claim.claimed &&
      disagreements_.back().claim.tube == claim.tube) {
    return 0;
  }
  const std::vector<Picture> pictures(recent_.begin(), recent_.end());
  disagreements_.push_back({++last_id_, at_s, std::move(wall), claim, {}, pictures});
  if (disagreements_.size() > kMostDisagreements) {
    disagreements_.pop_front();
  }
  if (disagreements_.size() > kMostWithPictures) {
    disagreements_[disagreements_.size() - kMostWithPictures - 1].pictures.clear();
  }
  return last_id_;
}

Json PageHistory::visits() const {
  constexpr std::array<const char*, 3> kWords = {"visited", "verified", "contradicted"};
  Json tubes = Json::array();
  for (const auto& [tube, visit] : visits_) {
    tubes.push_back({tube.row, tube.column, kWords[static_cast<std::size_t>(visit.told)],
                     visit.count, rounded(visit.last_s, 1e3)});
  }
  Json path = Json::array();
  for (const Place& place : path_) {
    path.push_back({rounded(place.x_mm, 1e2), rounded(place.y_mm, 1e2), rounded(place.at_s, 1e2)});
  }
  Json json = {{"since_s", path_.empty() ? Json() : Json(rounded(path_.front().at_s, 1e3))},
               {"tubes", std::move(tubes)},
               {"path", std::move(path)}};
  if (now_) {
    json["now"] = {{"x_mm", rounded(now_->x_mm, 1e2)}, {"y_mm", rounded(now_->y_mm, 1e2)}};
  }
  return json;
}

Json PageHistory::disagreements() const {
  Json all = Json::array();
  for (const Disagreement& each : disagreements_) {
    Json json = {
        {"id", each.id},
        {"at_s", rounded(each.at_s, 1e3)},
        {"wall", each.wall},
        {"claim", {{"row", each.claim.claimed.row}, {"column", each.claim.claimed.column}}},
        {"tube", {{"row", each.claim.tube.row}, {"column", each.claim.tube.column}}},
        {"words", claim_words(each.claim)},
        {"steps", each.pictures.size()}};
    json["acknowledged"] = each.acknowledged ? Json{{"name", each.acknowledged->name},
                                                    {"reason", each.acknowledged->reason},
                                                    {"at_s", rounded(each.acknowledged->at_s, 1e3)}}
                                             : Json();
    all.push_back(std::move(json));
  }
  return all;
}

PageHistory::Picture PageHistory::picture(std::int64_t disagreement, std::size_t step) const {
  for (const Disagreement& each : disagreements_) {
    if (each.id == disagreement && step < each.pictures.size()) {
      return each.pictures[step];
    }
  }
  return nullptr;
}

bool PageHistory::acknowledge(std::int64_t id, const std::string& name, const std::string& reason,
                              double at_s) {
  for (Disagreement& each : disagreements_) {
    if (each.id == id) {
      each.acknowledged = Acknowledged{name, reason, at_s};
      return true;
    }
  }
  return false;
}

}  // namespace tubesight::board
