#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/base/image_view.h"
#include "core/base/sighting.h"
#include "core/base/tube_address.h"
#include "core/overlay/pixels.h"

namespace tubesight::core::overlay {

/// Where a tube of the lattice is expected in the picture, seen or not [Fallon 6.1].
struct Estimate {
  TubeAddress address;
  ImagePoint center_px;
  TubeState state = TubeState::kOpen;
};

/// Everything that one picture's marks are drawn from; spans are only read while drawing.
struct OverlayInput {
  Sighting sighting;                         ///< the box's answer for this field
  std::span<const TubeSighting> tubes;       ///< tube-ends measured in this field
  std::optional<PixelBox> window;            ///< search window
  std::optional<ImagePoint> optimum_px;      ///< point of best light
  std::optional<ImagePoint> next_row_px;     ///< image of the tube centre at primary row + 1
  std::optional<ImagePoint> next_column_px;  ///< image of the tube centre at primary column + 1
  std::span<const Estimate> estimates;       ///< --overlay-estimates; empty otherwise
  std::optional<std::int64_t> field;         ///< the field's number, shown with the sighting's time
};

/// Copies a grey picture into the three channels of a buffer of the same size (asserted).
void copy_grey(const ImageView& grey, const RgbImageView& picture);

/// Draws the operator's display [Fallon 6.4] over a picture, as a rule one that copy_grey filled.
///
/// Marks, from below to above: search window and optimum point; estimates; tracked tube-ends (used:
/// green cross-hair, rejected: orange x, plug: magenta box); the point that the guidetube's axis
/// meets (pale ring, when axis_known); the large blue cross-hair on the tube above the guidetube
/// (when tool_known; its middle is filled when aligned and open otherwise); the L-shaped axes at
/// the primary tube, red along rows and yellow along columns; last the readout's black box at the
/// bottom. Every mark stands on the pixel nearest to its point. Marks are clipped at the picture's
/// edges; text is drawn whole or not at all. Any input is drawn without a fault; same input, same
/// bytes on every machine. Costs some 50,000 pixels; with n estimates also n^2 comparisons.
void draw_overlay(const RgbImageView& picture, const OverlayInput& input);

}  // namespace tubesight::core::overlay
