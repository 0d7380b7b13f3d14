#include "board/visionbox/page_json.h"

#include <cmath>
#include <numbers>

#include "board/box/advice.h"
#include "board/box/row_column_text.h"
#include "board/box/start_text.h"
#include "board/visionbox/page_numbers.h"
#include "core/base/names.h"
#include "core/base/words.h"
#include "core/tubesheet/sheet_places.h"

namespace tubesight::board {
namespace {

// As many digits as files have, and no more.
double told_px(std::int32_t q16) { return rounded(static_cast<double>(q16) / 65'536.0, 1e3); }
double told_mm(std::int64_t um_q8) { return rounded(mm(um_q8), 1e4); }
double told_s(core::FieldTime time) { return rounded(seconds(time), 1e6); }

Json point(core::ImagePoint at) { return {{"u", told_px(at.u_q16)}, {"v", told_px(at.v_q16)}}; }

Json address(core::TubeAddress tube) { return {{"row", tube.row}, {"column", tube.column}}; }

Json tube_at(core::TubeAddress tube, core::ImagePoint at) {
  Json made = address(tube);
  made.update(point(at));
  return made;
}

void add_tool(const core::Sighting& sighting, Json& json) {
  Json tool = tube_at(sighting.tool, sighting.tool_px);
  tool["offset_mm"] = told_mm(sighting.offset_um_q8);
  tool["dx_mm"] = told_mm(sighting.displacement_um_q8[0]);
  tool["dy_mm"] = told_mm(sighting.displacement_um_q8[1]);
  if (sighting.axis_known) {
    const double du = static_cast<double>(sighting.axis_px.u_q16) - sighting.tool_px.u_q16;
    const double dv = static_cast<double>(sighting.axis_px.v_q16) - sighting.tool_px.v_q16;
    tool["direction_deg"] = rounded(std::atan2(dv, du) * 180.0 / std::numbers::pi, 10.0);
  }
  json["tool"] = std::move(tool);
}

void add_place(const core::Sighting& sighting, Json& json) {
  if (sighting.primary_known) {
    json["primary"] = tube_at(sighting.primary, sighting.primary_px);
  }
  if (sighting.axis_known) {
    json["axis"] = point(sighting.axis_px);
    json["height_mm"] = told_mm(sighting.height_um_q8);
  }
  if (sighting.tool_known) {
    add_tool(sighting, json);
  }
  if (sighting.margin_known) {
    json["margin_sigma"] = rounded(sighting.margin_permyriad / 1e4, 1e4);
  }
  if (sighting.judged) {
    json["residual_px"] = told_px(sighting.residual_px_q16);
  }
  if (sighting.velocity_known) {
    json["velocity"] = {{"x_mm_s", rounded(sighting.velocity_um_s[0] / 1e3, 1e3)},
                        {"y_mm_s", rounded(sighting.velocity_um_s[1] / 1e3, 1e3)}};
  }
}

void add_tubes(const OverlaySnapshot& marks, Json& json) {
  Json tubes = Json::array();
  for (const core::TubeSighting& tube : marks.tubes) {
    tubes.push_back({tube.address.row, tube.address.column, told_px(tube.center_px.u_q16),
                     told_px(tube.center_px.v_q16), rounded(tube.quality_permyriad / 1e4, 1e4),
                     tube.plug ? 1 : 0, rounded(tube.contrast_q4 / 16.0, 16.0)});
  }
  json["tubes"] = std::move(tubes);
  if (!marks.estimates.empty()) {
    Json estimates = Json::array();
    for (const auto& tube : marks.estimates) {
      estimates.push_back({tube.address.row, tube.address.column, told_px(tube.center_px.u_q16),
                           told_px(tube.center_px.v_q16)});
    }
    json["estimates"] = std::move(estimates);
  }
}

void add_around(const OverlaySnapshot& marks, Json& json) {
  if (marks.next_row_px) {
    json["next_row"] = point(*marks.next_row_px);
  }
  if (marks.next_column_px) {
    json["next_column"] = point(*marks.next_column_px);
  }
  if (marks.around_tool_px) {
    Json around = Json::array();
    for (const core::ImagePoint& each : *marks.around_tool_px) {
      around.push_back(point(each));
    }
    json["around"] = std::move(around);
  }
  if (marks.news.claim()) {
    Json claim = claim_json(*marks.news.claim());
    if (marks.claimed_px) {
      claim.update(point(*marks.claimed_px));
    }
    json["claim"] = std::move(claim);
  }
}

void add_settings(const core::StartSettings& start, Json& json) {
  const auto& window = start.window_px;
  json["window"] = {{"left", window[0]},
                    {"top", window[1]},
                    {"width", window[2] - window[0] + 1},
                    {"height", window[3] - window[1] + 1}};
  json["optimum"] = {{"u", start.optimum_px[0]}, {"v", start.optimum_px[1]}};
}

void add_surroundings(const PageSurroundings& around, Json& json) {
  json["now_s"] = rounded(around.now_s, 1e6);
  if (around.lamp_dimmed) {
    json["lamp"] = {{"permille", around.lamp_permille},
                    {"automatic", around.lamp_automatic},
                    {"words", around.lamp_words}};
  }
  json["link"] = {{"state", around.link_state}, {"words", around.link_words}};
  json["camera"] = {{"words", around.camera_words},
                    {"fields_per_s", rounded(around.fields_per_s, 10.0)}};
}

/// [first, last, first, last ...] of the columns that stand in a row.
Json runs_of(const core::TubesheetSettings& sheet, std::int32_t row, std::int32_t stride) {
  Json runs = Json::array({row});
  std::optional<std::int32_t> last;
  for (std::int32_t column = sheet.columns[0]; column <= sheet.columns[1]; ++column) {
    if (core::tubesheet::check_address(sheet, {row, column}) !=
        core::tubesheet::AddressFault::kNone) {
      continue;
    }
    if (last && column == *last + stride) {
      runs.back() = column;
    } else {
      runs.push_back(column);
      runs.push_back(column);
    }
    last = column;
  }
  return runs;
}

template <typename List>
Json pairs_of(const List& tubes) {
  Json made = Json::array();
  for (const core::TubeAddress& tube : tubes) {
    made.push_back({tube.row, tube.column});
  }
  return made;
}

}  // namespace

Json sighting_json(const OverlaySnapshot& marks, const core::SessionSettings& told,
                   const PageSurroundings& around) {
  const core::Sighting& sighting = marks.sighting;
  Json json;
  json["field"] = marks.field;
  json["time_s"] = told_s(sighting.time);
  json["age_s"] = told_s(sighting.age);
  json["state"] = core::name_of(sighting.state);
  if (sighting.reason != core::Reason::kNone) {
    json["reason"] = core::name_of(sighting.reason);
    json["words"] = core::explain(sighting.reason);
    json["advice"] = advice_of(sighting.reason);
  }
  json["judged"] = sighting.judged;
  json["aligned"] = sighting.aligned;
  json["tracked"] = sighting.tracked;
  json["liveness"] = core::name_of(sighting.liveness);
  add_place(sighting, json);
  add_around(marks, json);
  add_tubes(marks, json);
  add_settings(told.start, json);
  add_surroundings(around, json);
  return json;
}

std::string claim_words(const core::ClaimReply& claim) {
  const std::string claimed = "the robot says tube " + row_column_text(claim.claimed);
  switch (claim.verdict) {
    case core::ClaimVerdict::kConfirmed: return claimed + ", and the box vouches for it";
    case core::ClaimVerdict::kContradicted:
      return claimed + ", and the box sees tube " + row_column_text(claim.tube);
    case core::ClaimVerdict::kUnknown: break;
  }
  return claimed + ", and the box cannot tell: " + std::string(core::explain(claim.doubt));
}

Json claim_json(const core::ClaimReply& claim) {
  Json json = address(claim.claimed);
  json["verdict"] = core::name_of(claim.verdict);
  json["words"] = claim_words(claim);
  if (claim.verdict != core::ClaimVerdict::kUnknown) {
    json["tube"] = address(claim.tube);
  } else if (claim.doubt != core::ClaimDoubt::kNone) {
    json["doubt"] = core::name_of(claim.doubt);
  }
  if (claim.field >= 0) {
    json["field"] = claim.field;
  }
  return json;
}

Json start_json(const core::StartReply& reply) {
  const bool taken = reply.refusal == core::StartRefusal::kNone;
  Json json = {{"taken", taken}};
  if (!taken) {
    json["refusal"] = core::name_of(reply.refusal);
    json["words"] = refusal_text(reply);
    json["advice"] = advice_of(reply.refusal);
    json["confirmable"] = reply.refusal == core::StartRefusal::kElsewhere;
    if (reply.click >= 0) {
      json["click"] = reply.click;
    }
  }
  return json;
}

Json pick_json(const core::PickReply& reply, bool plugged) {
  if (reply.doubt != core::PickDoubt::kNone) {
    return {{"doubt", core::name_of(reply.doubt)}, {"words", core::explain(reply.doubt)}};
  }
  Json json = address(reply.tube);
  json["kind"] = plugged ? "plug" : "tube";
  return json;
}

Json sheet_json(const core::TubesheetSettings& sheet) {
  const std::int32_t stride = sheet.addresses == core::AddressParity::kAll ? 1 : 2;
  Json rows = Json::array();
  for (std::int32_t row = sheet.rows[0]; row <= sheet.rows[1]; ++row) {
    rows.push_back(runs_of(sheet, row, stride));
  }
  const auto& row_step = sheet.row_step_mm;
  const auto& column_step = sheet.column_step_mm;
  const double product = row_step[0] * column_step[0] + row_step[1] * column_step[1];
  const bool square = std::abs(product) < 1e-6 && stride == 1 && sheet.odd_row_shift == 0.0;
  return {{"layout", square ? "square" : "triangular"},
          {"origin_mm", sheet.origin_mm},
          {"row_step_mm", row_step},
          {"column_step_mm", column_step},
          {"odd_row_shift", sheet.odd_row_shift},
          {"bore_mm", sheet.bore_mm},
          {"column_stride", stride},
          {"row_range", sheet.rows},
          {"column_range", sheet.columns},
          {"rows", std::move(rows)},
          {"plugs", pairs_of(sheet.plugged)},
          {"missing", pairs_of(sheet.missing)}};
}

}  // namespace tubesight::board
