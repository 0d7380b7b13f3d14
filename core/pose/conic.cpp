#include "core/pose/conic.h"

#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace tubesight::core::pose {

Conic conic_from(const Eigen::Matrix<double, 6, 1>& k) {
  Conic conic;
  conic << k(0), 0.5 * k(1), 0.5 * k(3), 0.5 * k(1), k(2), 0.5 * k(4), 0.5 * k(3), 0.5 * k(4), k(5);
  return conic;
}

bool is_ellipse(const Conic& conic) {
  const double quadratic = conic(0, 0) * conic(1, 1) - conic(0, 1) * conic(0, 1);
  // Definite quadratic part, and a determinant of the other sign than a: real and not a point.
  return quadratic > 0.0 && conic.determinant() * conic(0, 0) < 0.0;
}

Eigen::Vector2d center_of(const Conic& conic) {
  const double a = conic(0, 0);
  const double b = conic(0, 1);
  const double c = conic(1, 1);
  const double d = conic(0, 2);
  const double e = conic(1, 2);
  const double quadratic = a * c - b * b;
  return {(b * e - c * d) / quadratic, (b * d - a * e) / quadratic};
}

Conic transformed(const Conic& conic, const Eigen::Matrix3d& inverse) {
  const Conic result = inverse.transpose() * conic * inverse;
  return 0.5 * (result + result.transpose());
}

EllipseAxes axes_of(const Conic& conic) {
  const double a = conic(0, 0);
  const double b = conic(0, 1);
  const double c = conic(1, 1);
  const double quadratic = a * c - b * b;
  // At the centre p^T C p is determinant / quadratic; half axes are sqrt(-that / eigenvalue).
  const double level = -conic.determinant() / quadratic;
  const double mean = 0.5 * (a + c);
  const double spread = std::sqrt(0.25 * (a - c) * (a - c) + b * b);
  const double sign = mean < 0.0 ? -1.0 : 1.0;
  const double least = mean - sign * spread;  // of the smaller magnitude: the longer axis
  EllipseAxes axes;
  axes.major = std::sqrt(level / least);
  axes.minor = std::sqrt(level / (mean + sign * spread));
  const double angle = 0.5 * std::atan2(sign * 2.0 * b, sign * (a - c));  // of the shorter axis
  axes.direction = {-std::sin(angle), std::cos(angle)};
  return axes;
}

double distance_to(const Conic& conic, const Eigen::Vector2d& point) {
  const Eigen::Vector3d line = conic * point.homogeneous();
  const double value = point.homogeneous().dot(line);
  return value / (2.0 * line.head<2>().norm());
}

}  // namespace tubesight::core::pose
