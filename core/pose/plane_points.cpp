#include "core/pose/plane_points.h"

namespace tubesight::core::pose {
namespace {

PlanePoint plane_point(const camera::CameraModel<double>::Parameters& p,
                       const picture::RimPoint& point) {
  const double x = (point.u_px - p.center_px.x) / p.scale_px.x;
  const double y = (point.v_px - p.center_px.y) / p.scale_px.y;
  const double r2 = x * x + y * y;
  const double factor = 1.0 + r2 * (p.distortion + p.distortion2 * r2);
  // d factor / d(x, y) = slope (x, y)
  const double slope = 2.0 * (p.distortion + 2.0 * p.distortion2 * r2);
  PlanePoint out;
  out.x = x * factor;
  out.y = y * factor;
  out.x_u = (factor + slope * x * x) / p.scale_px.x;
  out.x_v = slope * x * y / p.scale_px.y;
  out.y_u = slope * x * y / p.scale_px.x;
  out.y_v = (factor + slope * y * y) / p.scale_px.y;
  out.normal_u = point.normal_u;
  out.normal_v = point.normal_v;
  out.weight = 1.0 / (point.sigma_px * point.sigma_px);
  return out;
}

}  // namespace

void to_plane_points(const camera::CameraModel<double>& camera, const picture::RimList& rims,
                     PlanePointBuffer& buffer) {
  std::size_t next = 0;
  buffer.rims = rims.size();
  for (std::int32_t rim = 0; rim < rims.size(); ++rim) {
    buffer.first[static_cast<std::size_t>(rim)] = static_cast<std::int32_t>(next);
    for (const picture::RimPoint& point : rims[rim].points) {
      buffer.points[next++] = plane_point(camera.parameters(), point);
    }
  }
  buffer.first[static_cast<std::size_t>(rims.size())] = static_cast<std::int32_t>(next);
}

}  // namespace tubesight::core::pose
