#include "core/calibration/opencv_lens.h"

#include <algorithm>
#include <cmath>

#include "core/math/small_matrix.h"

namespace tubesight::core::calibration {
namespace {

constexpr int kColumns = 33;
constexpr int kRows = 25;
constexpr int kFirstOfLens = 4;  // k is the first of ours that is no focal length, scale or centre
constexpr int kOfLens = CameraValues::RowsAtCompileTime - kFirstOfLens;

/// Pixels all over the picture, its corners among them.
template <typename Visit>
void over_picture(const Sensor& sensor, Visit visit) {
  for (int i = 0; i < kColumns * kRows; ++i) {
    visit(Eigen::Vector2d((i % kColumns) * (sensor.width_px - 1.0) / (kColumns - 1),
                          (i / kColumns) * (sensor.height_px - 1.0) / (kRows - 1)));
  }
}

/// Sums what the residuals come to.
class Spread {
 public:
  void add(const Eigen::Vector2d& off_px) {
    squares_ += off_px.squaredNorm();
    worst_ = std::max(worst_, off_px.norm());
    ++count_;
  }
  [[nodiscard]] ConversionResidual result() const {
    return {std::sqrt(squares_ / std::max(1, count_)), worst_};
  }

 private:
  double squares_ = 0.0;
  double worst_ = 0.0;
  int count_ = 0;
};

Eigen::Vector2d seen_over_focal(const OpencvLens& lens, const Eigen::Vector2d& pixel) {
  return {(pixel.x() - lens.cx_px) / lens.fx_px, (pixel.y() - lens.cy_px) / lens.fy_px};
}

/// The ideal place of what is seen, by Newton's method; false where the lens folds before it.
bool undistort(const OpencvLens& lens, const Eigen::Vector2d& seen, Eigen::Vector2d& ideal) {
  constexpr int kRounds = 60;
  constexpr double kStep = 1e-7;
  constexpr double kEnough = 1e-12;
  // From the middle outwards, so that it stays on the branch that begins there.
  ideal.setZero();
  for (int part = 1; part <= 8; ++part) {
    const Eigen::Vector2d goal = seen * (part / 8.0);
    double off = HUGE_VAL;
    for (int round = 0; round < kRounds && off > kEnough; ++round) {
      const Eigen::Vector2d miss = goal - distorted_by(lens, ideal);
      off = miss.norm();
      const Eigen::Vector2d by_x = (distorted_by(lens, ideal + Eigen::Vector2d(kStep, 0.0)) -
                                    distorted_by(lens, ideal - Eigen::Vector2d(kStep, 0.0))) /
                                   (2.0 * kStep);
      const Eigen::Vector2d by_y = (distorted_by(lens, ideal + Eigen::Vector2d(0.0, kStep)) -
                                    distorted_by(lens, ideal - Eigen::Vector2d(0.0, kStep))) /
                                   (2.0 * kStep);
      const double determinant = by_x.x() * by_y.y() - by_x.y() * by_y.x();
      if (!(determinant > 0.01)) {
        return false;
      }
      ideal += Eigen::Vector2d(miss.x() * by_y.y() - miss.y() * by_y.x(),
                               miss.y() * by_x.x() - miss.x() * by_x.y()) /
               determinant;
    }
    if (!(off < 1e-9)) {
      return false;
    }
  }
  return true;
}

/// What a ray of ours is off that of the lens, in pixels of the ideal image.
Eigen::Vector2d ray_off(const Sensor& sensor, const CameraValues& camera, const OpencvLens& lens,
                        const Eigen::Vector2d& pixel, const Eigen::Vector2d& ideal) {
  const Eigen::Vector2d ours = ideal_of(sensor, camera, pixel) / camera(0);
  return {lens.fx_px * (ideal.x() - ours.x()), lens.fy_px * (ideal.y() - ours.y())};
}

}  // namespace

Eigen::Vector2d distorted_by(const OpencvLens& lens, const Eigen::Vector2d& ideal) {
  const auto& [k1, k2, p1, p2, k3, k4, k5, k6] = lens.distortion;
  const double x = ideal.x();
  const double y = ideal.y();
  const double r2 = x * x + y * y;
  const double q =
      (1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1.0 + r2 * (k4 + r2 * (k5 + r2 * k6)));
  return {x * q + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * q + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

OpencvLens opencv_lens_of(const Sensor& sensor, const CameraValues& camera,
                          ConversionResidual& residual) {
  OpencvLens lens;
  lens.fx_px = camera(0) * camera(1) / sensor.column_mm;
  lens.fy_px = camera(0) / sensor.row_mm;
  lens.cx_px = camera(2);
  lens.cy_px = camera(3);
  // Linear in k1, k2, k3: what is seen less what is ideal is (k1 r^2 + k2 r^4 + k3 r^6) of it.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  over_picture(sensor, [&](const Eigen::Vector2d& pixel) {
    const Eigen::Vector2d ideal = ideal_of(sensor, camera, pixel) / camera(0);
    const Eigen::Vector2d seen = seen_over_focal(lens, pixel);
    const double r2 = ideal.squaredNorm();
    const Eigen::Vector3d powers(r2, r2 * r2, r2 * r2 * r2);
    for (const auto& [focal_px, place, off] :
         {std::array{lens.fx_px, ideal.x(), seen.x() - ideal.x()},
          std::array{lens.fy_px, ideal.y(), seen.y() - ideal.y()}}) {
      const Eigen::Vector3d row = focal_px * place * powers;
      normal += row * row.transpose();
      right += row * (focal_px * off);
    }
  });
  math::Cholesky<3> factor;
  if (factor.factor(normal)) {
    const Eigen::Vector3d values = factor.solve(right);
    lens.distortion[0] = values(0);
    lens.distortion[1] = values(1);
    lens.distortion[4] = values(2);
  }
  Spread spread;
  over_picture(sensor, [&](const Eigen::Vector2d& pixel) {
    const Eigen::Vector2d seen = distorted_by(lens, ideal_of(sensor, camera, pixel) / camera(0));
    spread.add({lens.fx_px * seen.x() + lens.cx_px - pixel.x(),
                lens.fy_px * seen.y() + lens.cy_px - pixel.y()});
  });
  residual = spread.result();
  return lens;
}

Result<CameraValues> camera_of(const Sensor& sensor, const OpencvLens& lens,
                               ConversionResidual& residual) {
  using OfLens = Eigen::Matrix<double, kOfLens, 1>;
  CameraValues camera = CameraValues::Zero();
  camera.head<4>() << lens.fy_px * sensor.row_mm,
      lens.fx_px * sensor.column_mm / (lens.fy_px * sensor.row_mm), lens.cx_px, lens.cy_px;
  constexpr int kRounds = 1;  // linear; one more to see what is left
  Spread spread;
  for (int round = 0; round <= kRounds; ++round) {
    Eigen::Matrix<double, kOfLens, kOfLens> normal =
        Eigen::Matrix<double, kOfLens, kOfLens>::Zero();
    OfLens right = OfLens::Zero();
    bool good = true;
    spread = Spread();
    over_picture(sensor, [&](const Eigen::Vector2d& pixel) {
      Eigen::Vector2d ideal;
      if (!good || !undistort(lens, seen_over_focal(lens, pixel), ideal)) {
        good = false;
        return;
      }
      const Eigen::Vector2d off = ray_off(sensor, camera, lens, pixel, ideal);
      spread.add(off);
      Eigen::Matrix<double, 2, kOfLens> slope;
      for (int i = 0; i < kOfLens; ++i) {
        constexpr double kStep = 1e-6;
        const CameraValues by = kStep * CameraValues::Unit(kFirstOfLens + i);
        slope.col(i) = (ray_off(sensor, camera - by, lens, pixel, ideal) -
                        ray_off(sensor, camera + by, lens, pixel, ideal)) /
                       (2.0 * kStep);
      }
      normal += slope.transpose() * slope;
      right += slope.transpose() * off;
    });
    math::Cholesky<kOfLens> factor;
    if (!good || !factor.factor(normal)) {
      return Unexpected(Error::kOutOfRange);
    }
    if (round < kRounds) {
      camera.tail<kOfLens>() += factor.solve(right);
    }
  }
  residual = spread.result();
  return camera;
}

}  // namespace tubesight::core::calibration
