#include "core/calibration/picture_cover.h"

#include <algorithm>
#include <cmath>

namespace tubesight::core::calibration {

UncoveredPart uncovered_part(const CalibrationData& data, const CameraValues& camera,
                             const math::Matrix6d& covariance) {
  constexpr int kColumns = 33;
  constexpr int kRows = 25;
  const double reach = data.sensor.height_px / 6.0;
  UncoveredPart part;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double squares = 0.0;
  int count = 0;
  for (int i = 0; i < kColumns * kRows; ++i) {
    const Eigen::Vector2d pixel((i % kColumns) * (data.sensor.width_px - 1.0) / (kColumns - 1),
                                (i / kColumns) * (data.sensor.height_px - 1.0) / (kRows - 1));
    const bool covered = std::any_of(data.dots.begin(), data.dots.end(), [&](const SeenDot& dot) {
      return dot.used && (dot.seen_px - pixel).squaredNorm() <= reach * reach;
    });
    if (!covered) {
      const double sigma = map_sigma_px(data.sensor, camera, covariance, pixel);
      squares += sigma * sigma;
      sum += pixel;
      ++count;
    }
  }
  if (count > 0) {
    part.share = static_cast<double>(count) / (kColumns * kRows);
    part.u_px = sum.x() / count;
    part.v_px = sum.y() / count;
    part.rms_px = std::sqrt(squares / count);
  }
  return part;
}

}  // namespace tubesight::core::calibration
