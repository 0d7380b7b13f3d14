#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/base/image_view.h"
#include "core/base/reply.h"
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

/// What became of a click of the operator's.
enum class ClickVerdict : std::uint8_t {
  kTaken,    ///< its start was taken
  kRefused,  ///< its start was refused
  kBlamed,   ///< its start was refused, and this click is why
};

/// A place where the operator clicked for a start, and the tube named there.
struct Click {
  ImagePoint at_px;
  TubeAddress address;
  ClickVerdict verdict = ClickVerdict::kTaken;
};

/// What the operator shall see longer than one field.
struct News {
  std::span<const Click> clicks;               ///< of the last start; empty: long ago
  StartRefusal refusal = StartRefusal::kNone;  ///< why it was refused
  std::optional<ClaimReply> claim;             ///< the last one's; empty: long ago
  std::optional<ImagePoint> claimed_px;        ///< image of the tube claimed, if contradicted
};

/// Half of the width and height of a tube-end's image.
struct HalfSize {
  std::int32_t u_px = 0;
  std::int32_t v_px = 0;
};

/// Everything that one picture's marks are drawn from; spans are only read while drawing.
struct OverlayInput {
  Sighting sighting;                         ///< the box's answer for this field
  std::span<const TubeSighting> tubes;       ///< tube-ends measured in this field
  std::optional<PixelBox> window;            ///< search window
  std::optional<ImagePoint> optimum_px;      ///< point of best light
  std::optional<ImagePoint> next_row_px;     ///< image of the tube centre at primary row + 1
  std::optional<ImagePoint> next_column_px;  ///< image of the tube centre at primary column + 1
  std::optional<HalfSize> tool_rim;          ///< of the tube above the guidetube
  std::int32_t aligned_within_um_q8 = 0;     ///< offset up to which it is aligned, 1/256 um
  std::span<const Estimate> estimates;       ///< --overlay-estimates; empty otherwise
  News news;
  std::optional<std::int64_t> field;  ///< the field's number, shown with the sighting's time
};

/// Height of the overlay of a camera's picture of this size: the readout stands below the picture.
[[nodiscard]] std::int32_t overlay_height_px(std::int32_t width_px, std::int32_t height_px);

/// Copies a grey picture into the three channels of the upper lines of a buffer that is as wide and
/// at least as high (asserted).
void copy_grey(const ImageView& grey, const RgbImageView& picture);

/// Draws the operator's display [Fallon 6.4] over a picture of overlay_height_px(), whose upper
/// lines hold the camera's picture, as a rule one that copy_grey filled. A picture not higher than
/// the readout is asserted.
///
/// Marks, from below to above: search window and optimum point; estimates; tracked tube-ends (used:
/// green cross-hair, rejected: orange x, plug: magenta box); the blue frame around the tube above
/// the guidetube (when tool_known; whole when aligned, its corners alone otherwise) and the arrow
/// from its centre to the point that the guidetube's axis meets, where there is room; the axes that
/// leave the primary tube, red along rows and yellow along columns; that point (pale ring, when
/// axis_known); a contradicted claim; clicks. docs/overlay.md shows each. Every mark stands on the
/// pixel nearest to its point and is clipped at the camera's picture; addresses are written whole
/// or not at all. The lines below hold the readout (readout.h). Marks and letters grow with the
/// picture's width.
///
/// Any input is drawn without a fault; same input, same bytes on every machine. Costs some 80,000
/// pixels at 635 px in width, most of them the readout's black; with n estimates also n^2
/// comparisons.
void draw_overlay(const RgbImageView& picture, const OverlayInput& input);

}  // namespace tubesight::core::overlay
