#include "drivers/files/recording_rows.h"

#include <array>
#include <cmath>
#include <optional>

#include "core/base/names.h"
#include "drivers/files/decimal.h"

namespace tubesight::drivers {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kMillimetre_nm = 1'000'000;
constexpr std::int64_t kDegree_ndeg = 1'000'000'000;

void append_address(std::string& out, core::TubeAddress address) {
  append_whole(out, address.row);
  out += ',';
  append_whole(out, address.column);
}

void append_scaled(std::string& out, double value, std::int32_t digits) {
  const double scale = std::pow(10.0, digits);
  append_decimal(out, std::llround(value * scale), std::llround(scale), digits);
}

void append_pose_result(std::string& out, const core::PoseResult& pose) {
  if (pose.reason != core::PoseReason::kNone) {
    out += core::name_of(pose.reason);
    return;
  }
  append_whole(out, pose.tubes);
  out += ',';
  append_address(out, pose.nearest);
  const auto append = [&out](std::int64_t value, std::int32_t digits, std::int64_t scale) {
    out += ',';
    append_decimal(out, value, scale, digits);
  };
  const auto append_six = [&append](const std::array<std::int64_t, 3>& lengths_nm,
                                    const std::array<std::int64_t, 3>& angles_ndeg) {
    for (const std::int64_t value : lengths_nm) {
      append(value, 6, kMillimetre_nm);
    }
    for (const std::int64_t value : angles_ndeg) {
      append(value, 9, kDegree_ndeg);
    }
  };
  append_six(pose.position_nm, pose.angles_ndeg);
  append_six(pose.position_sigma_nm, pose.angle_sigma_ndeg);
  append(pose.offset_nm, 6, kMillimetre_nm);
}

/// What the robot told of itself with its request: place, angles, joints' angles.
void append_robot_pose(std::string& out, const core::RobotPose& robot) {
  const char* comma = "";
  const auto append = [&](std::int64_t value, std::int32_t digits, std::int64_t scale) {
    out += comma;
    comma = ",";
    append_decimal(out, value, scale, digits);
  };
  for (const std::int64_t value : robot.position_nm) {
    append(value, 6, kMillimetre_nm);
  }
  if (robot.turned || robot.joints > 0) {
    for (const std::int64_t value : robot.angles_ndeg) {
      if (robot.turned) {
        append(value, 9, kDegree_ndeg);
      } else {
        out += ',';
      }
    }
  }
  for (std::int32_t i = 0; i < robot.joints; ++i) {
    append(robot.joints_ndeg[static_cast<std::size_t>(i)], 9, kDegree_ndeg);
  }
}

/// How places are written.
enum class Places : std::uint8_t {
  kThousandths,  ///< as a person reads them
  kExactly,      ///< so that the same number is read back
};

void append_place(std::string& out, double place_px, Places places) {
  if (places == Places::kThousandths) {
    append_scaled(out, place_px, 3);
  } else {
    out += number_text(place_px);
  }
}

void append_places(std::string& out, const std::array<double, 2>& at_px, Places places) {
  append_place(out, at_px[0], places);
  out += ',';
  append_place(out, at_px[1], places);
}

void append_clicks(std::string& out, const core::Start& start, Places places) {
  for (std::int32_t i = 0; i < start.tubes.size(); ++i) {
    out += i > 0 ? ";" : "";
    append_address(out, start.tubes[i].address);
    out += ',';
    append_places(out, start.tubes[i].at_px, places);
  }
}

/// The columns `kind,values`.
void append_kind_and_values(std::string& out, const core::Event& event, Places places) {
  const auto quoted = [&out](const char* kind, const auto& append) {
    out += kind;
    out += ",\"";
    append();
    out += '"';
  };
  std::visit(core::Overloaded{[&](const core::Claim& claim) {
                                quoted("claim", [&] { append_address(out, claim.tube); });
                              },
                              [&](const core::Start& start) {
                                quoted("start", [&] { append_clicks(out, start, places); });
                              },
                              [&](const core::LampCommand& lamp) {
                                out += "lamp,";
                                if (lamp.automatic) {
                                  out += "auto";
                                } else {
                                  append_whole(out, lamp.permille);
                                }
                              },
                              [&](const core::PoseRequest& request) {
                                if (!request.robot) {
                                  out += "pose,";
                                  return;
                                }
                                quoted("pose", [&] { append_robot_pose(out, *request.robot); });
                              },
                              [&](const core::Pick& pick) {
                                quoted("pick", [&] { append_places(out, pick.at_px, places); });
                              },
                              [&](const core::Acknowledge&) { out += "acknowledge,"; },
                              [&](const core::PoseResult& pose) {
                                quoted("pose-result", [&] { append_pose_result(out, pose); });
                              }},
             event.content);
}

/// The columns that all event files have, without the line feed.
void append_event_cells(std::string& out, std::int64_t field, const core::Event& event,
                        Places places) {
  append_whole(out, field);
  out += ',';
  if (event.at) {
    append_decimal(out, event.at->count(), kSecond_ns, 9);
  }
  out += ',';
  append_kind_and_values(out, event, places);
  out += ',';
  append_whole(out, event.id);
  out += ',';
  const auto* const start = core::content_if<core::Start>(event);
  const auto* const pick = core::content_if<core::Pick>(event);
  const auto seen = start != nullptr  ? start->seen_field
                    : pick != nullptr ? pick->seen_field
                                      : std::nullopt;
  if (seen) {
    append_whole(out, *seen);
  }
  out += start != nullptr && start->confirmed ? ",1" : ",";
}

}  // namespace

void append_event_row(std::string& out, std::int64_t field, const core::Event& event) {
  append_event_cells(out, field, event, Places::kThousandths);
  out += '\n';
}

void append_recorded_event_row(std::string& out, std::int64_t field, const core::Event& event) {
  append_event_cells(out, field, event, Places::kExactly);
  out += event.origin == core::EventOrigin::kRobot ? ",robot\n" : ",operator\n";
}

void append_meta_row(std::string& out, const core::Field& field) {
  append_whole(out, field.number);
  out += ',';
  if (field.status != core::FieldStatus::kMissing) {
    append_whole(out, field.sequence);
  }
  out += ',';
  append_decimal(out, field.mid_exposure.count(), kSecond_ns, 9);
  switch (field.status) {
    case core::FieldStatus::kGood: out += ",good,"; break;
    case core::FieldStatus::kDamaged: out += ",damaged,"; break;
    case core::FieldStatus::kMissing: out += ",missing,"; break;
  }
  append_whole(out, field.lamp_permille);
  out += '\n';
}

}  // namespace tubesight::drivers
