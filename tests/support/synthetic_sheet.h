#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/field.h"
#include "core/base/settings.h"
#include "core/base/tube_address.h"

namespace tubesight::tests {

/// T_sheet_tool: where the guidetube's tip is and how it is turned.
struct ToolPlace {
  double x_mm = 0.0;
  double y_mm = 0.0;
  double height_mm = 0.0;  ///< of the sheet above the tip
  double alpha_deg = 0.0;  ///< R_sheet_tool = Rz(alpha) Ry(beta) Rx(gamma)
  double beta_deg = 0.0;
  double gamma_deg = 0.0;
};

/// A tube-end that stands elsewhere than the lattice says.
struct DisplacedTube {
  core::TubeAddress address;
  std::array<double, 2> by_mm{};
};

/// What the pictures look like; grey levels before gain and offset.
struct SheetLook {
  double dark = 12.0;
  double sheet = 140.0;
  double blur_px = 1.6;  ///< a rise from dark to bright takes twice this
  bool fillet = false;   ///< a bright rim with its shadow outside instead of a sharp bore
  double rim = 210.0;
  double rim_mm = 1.2;
  double shadow = 45.0;
  double shadow_mm = 1.6;
  double plug_hole = 0.55;  ///< radius of a rolled plug's hole, as a share of the bore's
  double gain = 1.0;
  double offset = 0.0;  ///< gain 0 and offset 4: black; gain 0 and offset 255: white
  double noise = 0.0;   ///< standard deviation, grey levels
  std::array<std::int32_t, 4> bar_px{0, 0, -1, -1};  ///< guidetube: left, top, right, bottom
  double bar = 90.0;
  std::vector<core::TubeAddress> rolled_plugs;  ///< whatever the settings list
  std::vector<core::TubeAddress> flush_plugs;
  std::vector<DisplacedTube> displaced;
};

/// A picture of its own: exactly as many bytes on the heap as it has pixels.
using Frame = std::vector<std::uint8_t>;

/// Draws flat tubesheets as a distorting camera sees them, and knows where everything is.
///
/// Written from the conventions' formulas in plain double, without core/camera and core/tracking,
/// so that their tests have an independent truth. Only + - x / and square roots: every machine
/// draws the same bytes. Each pixel looks through its ray at the sheet; edges are ramps whose
/// middle is exact.
class SyntheticSheet {
 public:
  explicit SyntheticSheet(const core::SessionSettings& settings);

  SheetLook look;

  /// Draws the lines of `parity` into `frame` (resized to the camera's picture, other lines stay).
  void draw(const ToolPlace& place, core::Parity parity, std::uint32_t seed, Frame& frame) const;

  /// A field of a frame of this camera.
  [[nodiscard]] core::FieldView view(const Frame& frame, core::Parity parity) const;

  /// Pixel of a point of the sheet frame.
  [[nodiscard]] std::array<double, 2> image_of(const ToolPlace& place,
                                               const std::array<double, 3>& point_mm) const;
  /// Pixel of a tube's centre.
  [[nodiscard]] std::array<double, 2> image_of(const ToolPlace& place,
                                               core::TubeAddress address) const;
  /// Point of the sheet that a pixel shows; empty where it looks past the sheet.
  [[nodiscard]] std::optional<std::array<double, 2>> sheet_point(
      const ToolPlace& place, const std::array<double, 2>& pixel) const;
  /// Where the guidetube's axis meets the sheet.
  [[nodiscard]] std::array<double, 2> axis_point(const ToolPlace& place) const;
  /// Centre of a tube on the sheet.
  [[nodiscard]] std::array<double, 2> center_of(core::TubeAddress address) const;
  /// The tube of the lattice nearest to a point of the sheet, present or not.
  [[nodiscard]] core::TubeAddress nearest(const std::array<double, 2>& point_mm) const;

 private:
  struct Rays;
  enum class End : std::uint8_t { kOpen, kRolled, kNone };
  /// Everything around a point of the sheet.
  struct Surroundings {
    double radius_mm = 0.0;
    End end = End::kNone;
    std::array<double, 2> center{};  ///< of the nearest tube
  };
  /// A level, and how far away on the sheet it is the same at least.
  struct Grey {
    double level = 0.0;
    double clear_mm = 0.0;
  };

  [[nodiscard]] std::array<double, 2> ray_of(double u, double v) const;
  [[nodiscard]] Rays rays_of(const ToolPlace& place) const;
  [[nodiscard]] bool exists(core::TubeAddress address) const;
  [[nodiscard]] double squared_distance(core::TubeAddress address,
                                        const std::array<double, 2>& point_mm) const;
  [[nodiscard]] End end_of(core::TubeAddress address) const;
  [[nodiscard]] Surroundings around(const std::array<double, 2>& point_mm) const;
  [[nodiscard]] Grey grey(const Rays& rays, double scale, double u, double v) const;
  [[nodiscard]] double most_mm_per_px(const Rays& rays, std::int32_t u, std::int32_t v) const;

  core::CameraSettings camera_;
  double cell_mm_ = 0.0;  ///< width of a pixel on the sensor
  core::ToolSettings tool_;
  std::array<double, 2> origin_mm_{};
  std::array<double, 2> row_step_mm_{};
  std::array<double, 2> column_step_mm_{};
  double bore_mm_ = 0.0;
  core::AddressParity addresses_ = core::AddressParity::kAll;
  double odd_row_shift_ = 0.0;
  double alone_mm_ = 0.0;  ///< no two centres are so near to one point
  std::vector<core::TubeAddress> missing_;
  std::vector<core::TubeAddress> plugged_;
};

/// Settings of the source's camera (635 by 480, even lines first) on an ordinary tool below a
/// square sheet of 25.4 mm pitch, without clicks; `divisor` 2 gives a camera of half the lines and
/// columns.
void make_synthetic_settings(core::SessionSettings& settings, std::int32_t divisor = 1);

/// A click for every address, `off_px` beside the centre's true image.
void set_clicks(const SyntheticSheet& sheet, const ToolPlace& place,
                const std::vector<core::TubeAddress>& addresses,
                const std::array<double, 2>& off_px, core::SessionSettings& settings);

}  // namespace tubesight::tests
