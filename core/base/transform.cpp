#include "core/base/transform.h"

namespace tubesight::core {

Eigen::Matrix3d rotation_from_degrees(const std::array<double, 3>& angles_deg) {
  const auto [sa, ca] = sine_cosine(radians(angles_deg[0]));
  const auto [sb, cb] = sine_cosine(radians(angles_deg[1]));
  const auto [sg, cg] = sine_cosine(radians(angles_deg[2]));
  Eigen::Matrix3d rotation;
  rotation << ca * cb, ca * sb * sg - sa * cg, ca * sb * cg + sa * sg,  //
      sa * cb, sa * sb * sg + ca * cg, sa * sb * cg - ca * sg,          //
      -sb, cb * sg, cb * cg;
  return rotation;
}

}  // namespace tubesight::core
