// model_error FOLDER: how well the model places tube-ends that it has not measured [Fallon
// eq. 6.26].
//
// Tracks a recording in fixed point. In each field the pose is then fitted in double precision to
// half of the measured tube-ends, and the centres of the other half are predicted from it:
//   `between`: every other tube-end, in both roles;
//   `beyond`:  the half nearer to the optimum point tells where the farther half is.
//
// Writes CSV to standard output, one row a prediction; accuracy.py compares it with the truth.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "core/tracking/pose_fit.h"
#include "core/tracking/projection.h"
#include "core/tracking/start.h"
#include "core/tracking/tracking_setup.h"
#include "tests/benchmark/recorded_session.h"

namespace tubesight::tests {
namespace {

using namespace core::tracking;
using Model = TrackingModel<double>;
using Pose = SheetPose<double>;
using Point = core::Vector2<double>;

// The measured tube-ends of a field, each weighted like a rim read all around.
MeasurementList<double> measured(const Model& model, const Pose& pose,
                                 const TubeSightingList& sightings) {
  MeasurementList<double> tubes;
  for (const core::TubeSighting& sighting : sightings) {
    if (sighting.plug || sighting.quality_permyriad == 0) {
      continue;
    }
    TubeMeasurement<double> tube;
    tube.address = sighting.address;
    tube.local = model.lattice.offset(pose.anchor, sighting.address);
    tube.center_px = {sighting.center_px.u_q16 / 65536.0, sighting.center_px.v_q16 / 65536.0};
    tube.information_uu = 4.0;
    tube.information_vv = 4.0;
    static_cast<void>(tubes.try_push_back(tube));
  }
  return tubes;
}

bool fit(const Model& model, MeasurementList<double> tubes, Pose& pose) {
  NormalEquations<double> equations;
  return tubes.size() >= 3 && fit_pose<double>(model, {}, tubes, equations, pose).solved;
}

// Half the smallest width of the rim's image: half the smallest distance between parallel tangents.
double minor_radius(const Model& model, const Pose& pose, const Point& local) {
  constexpr int kPoints = 72;
  std::array<Point, kPoints> rim{};
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * 3.14159265358979 * i / kPoints;
    const auto pixel = project<double>(model, pose,
                                       {local.x + model.bore_radius_mm * std::cos(angle),
                                        local.y + model.bore_radius_mm * std::sin(angle)});
    if (!pixel) {
      return 0.0;
    }
    rim[static_cast<std::size_t>(i)] = *pixel;
  }
  double smallest = 1e9;
  for (int i = 0; i < kPoints / 2; ++i) {
    const double angle = 2.0 * 3.14159265358979 * i / kPoints;
    double low = 1e9;
    double high = -1e9;
    for (const Point& point : rim) {
      const double along = point.x * std::cos(angle) + point.y * std::sin(angle);
      low = std::min(low, along);
      high = std::max(high, along);
    }
    smallest = std::min(smallest, (high - low) / 2.0);
  }
  return smallest;
}

void predict_others(const Model& model, const char* split, std::int64_t field, const Pose& pose,
                    const MeasurementList<double>& known, const MeasurementList<double>& unknown) {
  Pose fitted = pose;
  if (!fit(model, known, fitted)) {
    return;
  }
  for (const TubeMeasurement<double>& tube : unknown) {
    const auto center = project<double>(model, fitted, tube.local);
    const double radius = minor_radius(model, fitted, tube.local);
    if (center && radius > 0.0) {
      std::printf("%s,%lld,%d,%d,%.3f,%.3f,%.3f,%.3f,%.3f\n", split, static_cast<long long>(field),
                  tube.address.row, tube.address.column, center->x, center->y, tube.center_px.x,
                  tube.center_px.y, radius);
    }
  }
}

// The list stands in the order of the distance from the optimum point.
void predict_halves(const Model& model, std::int64_t field, const Pose& pose,
                    const MeasurementList<double>& tubes) {
  MeasurementList<double> halves[2];
  MeasurementList<double> nearer;
  MeasurementList<double> farther;
  for (std::int32_t i = 0; i < tubes.size(); ++i) {
    static_cast<void>(halves[i % 2].try_push_back(tubes[i]));
    static_cast<void>((2 * i < tubes.size() ? nearer : farther).try_push_back(tubes[i]));
  }
  predict_others(model, "between", field, pose, halves[0], halves[1]);
  predict_others(model, "between", field, pose, halves[1], halves[0]);
  predict_others(model, "beyond", field, pose, nearer, farther);
}

bool run(const RecordedSession& recording) {
  const auto model = std::make_unique<Model>();
  const auto map = std::make_unique<core::tubesheet::SheetMap>();
  SessionRun<core::FixedPoint> run;
  if (!make_tracking_model<double>(recording.settings(), *model) ||
      !map->assign(recording.settings().tubesheet) || !run.configure(recording.settings())) {
    return false;
  }
  LightLevels light;
  Pose pose;
  if (!find_start_pose<double>(*model, *map, recording.fields().front().pixels,
                               make_start_clicks(recording.settings().start.tubes),
                               ClickSearch::kBisected, light, pose)
           .taken()) {
    return false;
  }
  std::printf("split,field,row,column,u_px,v_px,measured_u_px,measured_v_px,minor_radius_px\n");
  for (std::size_t i = 0; i < recording.fields().size(); ++i) {
    run.give(recording.fields()[i]);
    run.step();
    const auto tubes = measured(*model, pose, run.output().tubes);
    if (fit(*model, tubes, pose)) {
      predict_halves(*model, recording.numbers()[i], pose, tubes);
    }
  }
  return true;
}

}  // namespace
}  // namespace tubesight::tests

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: model_error FOLDER\n");
    return 2;
  }
  tubesight::tests::RecordedSession recording;
  tubesight::drivers::Messages messages;
  if (!recording.load(arguments[1], messages)) {
    for (const std::string& message : messages) {
      std::fprintf(stderr, "%s\n", message.c_str());
    }
    return 2;
  }
  if (!tubesight::tests::run(recording)) {
    std::fprintf(stderr, "%s: the start was refused\n", arguments[1]);
    return 1;
  }
  return 0;
}
