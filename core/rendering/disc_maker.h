#pragma once

#include <array>
#include <cstdint>

#include "core/base/static_vector.h"
#include "core/rendering/disc.h"
#include "core/rendering/exposure.h"
#include "core/rendering/light_grid.h"
#include "core/rendering/scene.h"
#include "core/rendering/tube_ends.h"
#include "core/rendering/view.h"

namespace tubesight::core::rendering {

/// Makes the discs that one tube-end is drawn with, in the order to draw them.
class DiscMaker {
 public:
  static constexpr std::int32_t kMaxDiscsOfTube = 8;
  using Discs = StaticVector<Disc, kMaxDiscsOfTube>;

  DiscMaker(const Scene& scene, const View& view, const Exposure& exposure, const LightGrid& light,
            TubeAddress address, const TubeEnd& end);

  [[nodiscard]] const Discs& discs() const { return discs_; }

  /// Whether a tube-end at a place of the sheet may show in lines top..bottom; quick, and rather
  /// yes.
  [[nodiscard]] static bool may_be_seen(const Scene& scene, const View& view,
                                        const std::array<double, 2>& sheet_mm, std::int32_t top,
                                        std::int32_t bottom);

 private:
  /// Where a disc is; `outer_mm` counts for what is around it, `blur_px` is the sigma of its edge.
  struct Place {
    std::array<double, 3> center_mm{};
    double radius_mm = 0.0;
    double outer_mm = 0.0;
    double blur_px = 0.8;
  };

  /// A disc's geometry; its last line lies before its first when it is not seen.
  [[nodiscard]] Disc placed(const Place& place) const;
  void add(const Disc& disc);
  void add_solid(double z_mm, double radius_mm, double level, double extra = 0.0);
  void add_open(const LampLight& lamp, double vignette);
  void add_fillet(const LampLight& lamp);
  void add_flush_plug();
  void add_rolled_plug();
  void add_boron();

  /// 0 <= share < 1 of this tube-end; `what` tells its uses apart.
  [[nodiscard]] double share(std::uint32_t what) const;

  const Scene& scene_;
  const View& view_;
  TubeAddress address_;
  TubeEnd end_;
  Discs discs_;
};

}  // namespace tubesight::core::rendering
