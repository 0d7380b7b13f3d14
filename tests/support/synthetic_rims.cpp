#include "tests/support/synthetic_rims.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tubesight::tests {
namespace {

using Point = std::array<double, 2>;

// One tube-end as it stands: off its place, of its own diameter.
struct End {
  std::array<double, 3> center{};
  double radius = 0.0;

  [[nodiscard]] std::array<double, 3> at(double angle) const {
    return {center[0] + radius * std::cos(angle), center[1] + radius * std::sin(angle), center[2]};
  }
};

bool inside(const core::CameraSettings& camera, const Point& p) {
  return p[0] > 1.0 && p[1] > 1.0 && p[0] < camera.width_px - 2.0 && p[1] < camera.height_px - 2.0;
}

}  // namespace

double Deviates::uniform() {
  // xorshift64* [Vigna2016]
  state_ ^= state_ >> 12;
  state_ ^= state_ << 25;
  state_ ^= state_ >> 27;
  return static_cast<double>((state_ * 2685821657736338717U) >> 11) * 0x1p-53;
}

double Deviates::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(6.283185307179586 * uniform());
}

void make_rims(const SyntheticSheet& sheet, const core::SessionSettings& settings,
               const ToolPlace& place, const std::vector<core::TubeAddress>& addresses,
               const RimLook& look, Deviates& deviates, core::picture::RimList& rims) {
  rims.clear();
  const double degree = 3.14159265358979323846 / 180.0;
  for (const core::TubeAddress& address : addresses) {
    const Point center = sheet.center_of(address);
    const End end{{center[0] + look.center_sigma_mm * deviates.normal(),
                   center[1] + look.center_sigma_mm * deviates.normal(),
                   look.height_sigma_mm * deviates.normal()},
                  0.5 * (settings.tubesheet.bore_mm + look.bore_sigma_mm * deviates.normal())};
    static core::picture::Rim rim;
    rim.address = address;
    rim.points.clear();
    bool whole = true;
    for (std::int32_t i = 0; i < look.points; ++i) {
      const double angle = degree * look.arc_deg * i / look.points;
      const Point p = sheet.image_of(place, end.at(angle));
      const Point before = sheet.image_of(place, end.at(angle - 1e-3));
      const Point after = sheet.image_of(place, end.at(angle + 1e-3));
      const Point middle = sheet.image_of(place, end.center);
      double nu = after[1] - before[1];
      double nv = before[0] - after[0];
      const double outwards = nu * (p[0] - middle[0]) + nv * (p[1] - middle[1]) < 0.0 ? -1.0 : 1.0;
      const double length = outwards * std::hypot(nu, nv);
      nu /= length;
      nv /= length;
      double off = look.offset_px + look.noise_px * deviates.normal();
      if (look.outlier_share > 0.0 && deviates.uniform() < look.outlier_share) {
        off += 6.0 * deviates.uniform() - 3.0;
      }
      whole = whole && inside(settings.camera, p);
      static_cast<void>(
          rim.points.try_push_back({p[0] + off * nu, p[1] + off * nv, nu, nv, look.sigma_px}));
    }
    if (whole) {
      static_cast<void>(rims.try_push_back(rim));
    }
  }
}

std::vector<core::TubeAddress> addresses_around(const SyntheticSheet& sheet, const ToolPlace& place,
                                                std::size_t count, std::int32_t half) {
  const Point axis = sheet.axis_point(place);
  const core::TubeAddress middle = sheet.nearest(axis);
  std::vector<core::TubeAddress> addresses;
  for (std::int32_t row = -half; row <= half; ++row) {
    for (std::int32_t column = -half; column <= half; ++column) {
      addresses.push_back({middle.row + row, middle.column + column});
    }
  }
  const auto distance = [&](const core::TubeAddress& address) {
    const Point center = sheet.center_of(address);
    return std::hypot(center[0] - axis[0], center[1] - axis[1]);
  };
  std::stable_sort(addresses.begin(), addresses.end(),
                   [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  addresses.resize(std::min(count, addresses.size()));
  return addresses;
}

}  // namespace tubesight::tests
