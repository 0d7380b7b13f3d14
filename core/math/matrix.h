#pragma once

#include <Eigen/Core>

namespace tubesight::core::math {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

}  // namespace tubesight::core::math
