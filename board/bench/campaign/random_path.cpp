#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "board/bench/campaign/random_parts.h"
#include "core/tubesheet/tubesheet_setup.h"

namespace tubesight::board::campaign {
namespace {

using core::TubeAddress;
using core::kinematics::PathSegment;
using core::kinematics::SegmentKind;
using core::kinematics::SpeedShape;
using core::kinematics::ToolPath;
using core::kinematics::ToolPlace;
using core::rendering::TubeEndKind;
using core::rendering::TubeEnds;
using core::tubesheet::center_mm;
using drivers::Scenario;

constexpr double kWanted_s = 1.15;   // pieces are added until the path lasts so long
constexpr double kLongest_s = 1.45;  // and it is cut off here
constexpr double kClicked_s = 0.1;   // nothing moves sooner after an operator's clicks
constexpr double kJumpsOffLattice = 0.3;
constexpr double kJumpSpeed_mm_s = 5000.0;

bool well_inside(TubeAddress address, std::int32_t border) {
  return std::min(address.row, address.column) >= border &&
         std::max(address.row, address.column) <= kLastAddress - border;
}

/// Draws the pieces of one path.
class PathDrawing {
 public:
  PathDrawing(SpeedBand band, RandomSource& random, const TubeEnds& ends, Scenario& scenario)
      : band_(band),
        random_(random),
        ends_(ends),
        scenario_(scenario),
        pitch_(pitch_mm(scenario.scene.sheet)) {}

  void draw(bool jumps) {
    scenario_.path.clear();
    draw_limits();
    begin();
    add_rest(kClicked_s);
    add_move();
    add_rest();
    if (jumps) {
      add_jump();
    }
    while (path().duration_s() < kWanted_s) {
      add_piece();
      add_rest();
    }
    scenario_.video.length_s = std::min(path().duration_s(), kLongest_s);
  }

 private:
  [[nodiscard]] const ToolPath& path() const { return *path_; }

  void append(const PathSegment& segment) {
    if (path_->add(segment)) {
      scenario_.path.push_back(segment);
    }
  }

  void draw_limits() {
    auto& motion = scenario_.told.motion;
    motion = {};
    if (band_ == SpeedBand::kFast && random_.chance(0.5)) {
      motion.max_speed_mm_s = random_.between(300.0, 1000.0);
      motion.max_acceleration_mm_s2 = random_.between(3000.0, 8000.0);
    }
  }

  // A tube's place, with what a robot is off: within a millimetre, tenths of a degree.
  ToolPlace place_under(const std::array<double, 2>& center) {
    ToolPlace place;
    place.x_mm = center[0] + random_.normal(0.4);
    place.y_mm = center[1] + random_.normal(0.4);
    return place;
  }

  void begin() {
    core::rendering::NearestTube tube;
    do {
      const auto near = center_mm(scenario_.scene.sheet, {random_.whole(6, kLastAddress - 6),
                                                          random_.whole(6, kLastAddress - 6)});
      tube = ends_.nearest(near);
    } while (tube.kind == TubeEndKind::kVoid);
    ToolPlace start = place_under(ends_.lattice_point(tube.address));
    docked_ = random_.chance(0.12);
    start.height_mm = docked_ ? random_.between(0.0, 8.0) : random_.between(38.0, 75.0);
    start.alpha_deg = random_.between(-180.0, 180.0);
    if (!docked_) {
      start.beta_deg = random_.normal(0.3);
      start.gamma_deg = random_.normal(0.3);
    }
    scenario_.from = start;
    static_cast<void>(path_->begin(start));
  }

  void add(PathSegment segment, double speed, double acceleration) {
    segment.shape = random_.chance(0.5) ? SpeedShape::kTrapezoid : SpeedShape::kSCurve;
    segment.limits = {speed, acceleration, acceleration * random_.between(10.0, 60.0)};
    append(segment);
  }

  void add_rest(double least_s = 0.03) {
    PathSegment segment;
    segment.kind = SegmentKind::kRest;
    segment.rest_s = random_.between(least_s, 0.2);
    append(segment);
  }

  double band_speed() {
    const double most = 0.98 * scenario_.told.motion.max_speed_mm_s;
    return band_ == SpeedBand::kSlow ? random_.between(30.0, 150.0) : random_.between(150.0, most);
  }

  double some_acceleration() {
    return scenario_.told.motion.max_acceleration_mm_s2 * random_.between(0.2, 0.95);
  }

  void add_move() {
    if (docked_) {
      add_height();  // nothing moves sideways with the guidetube at the sheet
    }
    const double speed = band_speed();
    const double longest = std::clamp(speed * 0.7, 1.2 * pitch_, 14.0 * pitch_);
    const ToolPlace from = path().end();
    std::array<double, 2> to{from.x_mm, from.y_mm};
    for (int tries = 0; tries < 30; ++tries) {
      const double way = random_.between(pitch_, longest);
      const double heading = random_.between(0.0, 2.0 * std::numbers::pi);
      const auto tube =
          ends_.nearest({from.x_mm + way * std::cos(heading), from.y_mm + way * std::sin(heading)});
      // Now and then the tool stops under a void, on purpose.
      if (well_inside(tube.address, 3) &&
          (tube.kind != TubeEndKind::kVoid || random_.chance(0.1))) {
        const ToolPlace place = place_under(ends_.lattice_point(tube.address));
        to = {place.x_mm, place.y_mm};
        break;
      }
    }
    PathSegment segment;
    segment.kind = SegmentKind::kMove;
    segment.to_mm = to;
    add(segment, speed, some_acceleration());
  }

  // Up to the working height, to another one, or down to dock.
  void add_height() {
    PathSegment segment;
    const double speed = std::min(band_speed(), 200.0);
    if (docked_ || random_.chance(0.5)) {
      segment.kind = SegmentKind::kHeight;
      segment.height_mm = random_.between(38.0, 75.0);
      docked_ = false;
    } else {
      segment.kind = SegmentKind::kDock;
      segment.height_mm = random_.between(0.0, 6.0);
      docked_ = true;
    }
    add(segment, speed, some_acceleration());
  }

  void add_piece() {
    const std::int32_t choice = random_.whole(0, 9);
    PathSegment segment;
    if (choice < 5) {
      add_move();
    } else if (choice < 8 || docked_) {
      add_height();
    } else if (choice == 8) {
      segment.kind = SegmentKind::kTurn;
      segment.alpha_deg = path().end().alpha_deg + random_.between(-8.0, 8.0);
      add(segment, random_.between(5.0, 30.0), random_.between(50.0, 300.0));
    } else {
      segment.kind = SegmentKind::kLean;
      segment.lean_deg = {random_.normal(0.3), random_.normal(0.3)};
      add(segment, random_.between(1.0, 5.0), random_.between(10.0, 50.0));
    }
  }

  // Somewhere else at once, clear of every place that another tube's neighbourhood resembles: 2.5
  // times what the limits let the tool go astray in a field.
  void add_jump() {
    const double time_s = field_s(scenario_);
    const double astray = scenario_.told.motion.max_acceleration_mm_s2 * time_s * time_s;
    const std::array<double, 2> tube =
        ends_.lattice_point(ends_.nearest({path().end().x_mm, path().end().y_mm}).address);
    for (int tries = 0; tries < 100; ++tries) {
      const std::array<double, 2> by{random_.between(-2.0 * pitch_, 2.0 * pitch_),
                                     random_.between(-2.0 * pitch_, 2.0 * pitch_)};
      if (ends_.nearest({tube[0] + by[0], tube[1] + by[1]}).offset_mm < 2.5 * astray + 1.0) {
        continue;
      }
      // It takes 5 to 23 ms, up to one and a half fields: no robot can follow.
      PathSegment segment;
      segment.kind = SegmentKind::kMove;
      segment.to_mm = {path().end().x_mm + by[0], path().end().y_mm + by[1]};
      segment.limits = {kJumpSpeed_mm_s, 1e6, 1e9};
      append(segment);
      return;
    }
  }

  SpeedBand band_;
  RandomSource& random_;
  const TubeEnds& ends_;
  Scenario& scenario_;
  double pitch_;
  bool docked_ = false;
  std::unique_ptr<ToolPath> path_ = std::make_unique<ToolPath>();
};

}  // namespace

void draw_path(const Stratum& stratum, RandomSource& random, const TubeEnds& ends,
               Scenario& scenario) {
  const bool jumps = stratum.fault == FaultGroup::kJump && random.chance(kJumpsOffLattice);
  PathDrawing(stratum.speed, random, ends, scenario).draw(jumps);
}

}  // namespace tubesight::board::campaign
