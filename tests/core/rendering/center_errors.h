#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/frames.h"
#include "core/base/sighting.h"
#include "core/base/transform.h"
#include "core/rendering/truth.h"

namespace tubesight::core::rendering {

/// How far measured tube-ends are from where the scene's truth has their centres.
class CenterErrors {
 public:
  /// Takes those of a field that were measured and used, with the tool at its middle.
  void add(const Truth& truth, const Transform<frames::Sheet, frames::Tool>& T_sheet_tool,
           std::span<const TubeSighting> tubes) {
    for (const TubeSighting& tube : tubes) {
      const auto at = truth.image_of(T_sheet_tool, truth.tube_ends().at(tube.address).center_mm);
      if (tube.quality_permyriad > 0 && !tube.plug && at) {
        const double du = tube.center_px.u_q16 / 65536.0 - (*at)[0];
        const double dv = tube.center_px.v_q16 / 65536.0 - (*at)[1];
        squares_ += du * du + dv * dv;
        ++count_;
      }
    }
  }

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] double rms_px() const { return std::sqrt(squares_ / std::max(count_, 1)); }

 private:
  double squares_ = 0.0;
  int count_ = 0;
};

}  // namespace tubesight::core::rendering
