#include "core/tracking/clicked_tube.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>

#include "core/base/instantiate.h"
#include "core/edges/dark_region.h"
#include "core/edges/round_region.h"

namespace tubesight::core::tracking {
namespace {

// A tube-end fills a third of the picture at most.
template <Scalar S>
std::int32_t reach_px(const TrackingModel<S>& model) {
  return model.picture_width_px / 4;
}

// How large it is, is not known yet: a small one is looked at more closely.
template <Scalar S>
ClickedTube bisect(const TrackingModel<S>& model, const FieldView& field, std::int32_t u_px,
                   std::int32_t v_px, const edges::DynamicThreshold& first_threshold) {
  constexpr std::int32_t kReadings = 20;  // across one
  const auto look = [&](std::int32_t step_px) {
    edges::DynamicThreshold threshold = first_threshold;
    return edges::find_dark_region(field, u_px, v_px, reach_px(model), threshold, step_px);
  };
  edges::DarkRegion region = look(model.reading_step_px);
  const bool large = region.height_q16() / 65536 >= kReadings * model.reading_step_px;
  if (model.reading_step_px > 1 && !(region.found && large)) {
    region = look(1);
  }
  return {region.found,       region.center_u_q16(), region.center_v_q16(),
          region.width_q16(), region.height_q16(),   0};
}

// The virtual plane shows the sheet's circles as circles. With p_u and p_v what a pixel to the
// right and one down is there, the picture of its axes is
//
//   [along across] ~ [p_u p_v]^-1 ~ [p_vy -p_vx; -p_uy p_ux],
//
// where the factor does not matter: the longer is made `step_px` long, to an eighth.
template <Scalar S>
std::optional<edges::CircleShape> shape_at(const TrackingModel<S>& model, std::int32_t u_px,
                                           std::int32_t v_px, std::int32_t step_px) {
  constexpr std::int32_t kSpan_px = 8;
  const auto place = [&](std::int32_t u, std::int32_t v) {
    return model.virtual_plane.from_image(
        model.camera.to_plane({from_scaled<Px<S>>(u, 0), from_scaled<Px<S>>(v, 0)}));
  };
  const auto here = place(u_px, v_px);
  const auto right = place(u_px + kSpan_px, v_px);
  const auto below = place(u_px, v_px + kSpan_px);
  if (!here || !right || !below) {
    return std::nullopt;
  }
  const auto raw = [](Mm<S> value) { return std::int64_t{to_scaled(value, 20)}; };
  const std::int64_t along_u = raw(below->y - here->y);
  const std::int64_t along_v = -raw(right->y - here->y);
  const std::int64_t across_u = -raw(below->x - here->x);
  const std::int64_t across_v = raw(right->x - here->x);
  const auto length = [](std::int64_t u, std::int64_t v) {
    const std::int64_t longer = std::max(std::abs(u), std::abs(v));
    return longer + (std::min(std::abs(u), std::abs(v)) * 3) / 8;
  };
  const std::int64_t longest = std::max(length(along_u, along_v), length(across_u, across_v));
  if (longest == 0) {
    return std::nullopt;
  }
  const auto scaled = [&](std::int64_t value) {
    return static_cast<std::int32_t>(value * step_px * 65536 / longest);
  };
  return edges::CircleShape{scaled(along_u), scaled(along_v), scaled(across_u), scaled(across_v)};
}

// Whether a pixel lies within nine tenths of a circle's picture.
bool holds(const ClickedTube& tube, std::int32_t u_px, std::int32_t v_px) {
  const std::int64_t u = (u_px * 65536 - tube.center_u_q16) / 256;
  const std::int64_t v = (v_px * 65536 - tube.center_v_q16) / 256;
  const std::int64_t half_u = tube.width_q16 / 512;
  const std::int64_t half_v = tube.height_q16 / 512;
  // (u / half_u)^2 + (v / half_v)^2 < 0.81, in shares of 1/1024.
  const auto share2 = [](std::int64_t off, std::int64_t half) {
    const std::int64_t share = half > 0 ? off * 1024 / half : 1024;
    return share * share;
  };
  return share2(u, half_u) + share2(v, half_v) < 1024 * 1024 * 81 / 100;
}

// From the click, and where that is under a bright spot, from places around it.
template <Scalar S>
ClickedTube find_round(const TrackingModel<S>& model, const FieldView& field, std::int32_t u_px,
                       std::int32_t v_px) {
  constexpr std::int32_t kAside = 12;  // readings: inside most tube-ends, outside small spots
  constexpr std::array<std::array<std::int32_t, 2>, 9> kPlaces{
      {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
  const std::int32_t aside_px = kAside * model.reading_step_px;
  for (const auto& [right, down] : kPlaces) {
    const ClickedTube tube =
        find_circle<S>(model, field, u_px + right * aside_px, v_px + down * aside_px);
    if (tube.found && holds(tube, u_px, v_px)) {
      return tube;
    }
  }
  return {};
}

}  // namespace

template <Scalar S>
ClickedTube find_circle(const TrackingModel<S>& model, const FieldView& field, std::int32_t u_px,
                        std::int32_t v_px) {
  const std::int32_t step_px = model.reading_step_px;
  const auto shape = shape_at<S>(model, u_px, v_px, step_px);
  if (!shape) {
    return {};
  }
  const edges::RoundRegion region =
      edges::find_round_region(field, u_px, v_px, *shape, reach_px(model) / step_px);
  return {region.found,     region.center_u_q16, region.center_v_q16,
          region.width_q16, region.height_q16,   (region.inside + region.outside) / 2};
}

template <Scalar S>
ClickedTube find_clicked_tube(const TrackingModel<S>& model, const FieldView& field,
                              std::int32_t u_px, std::int32_t v_px, ClickSearch search,
                              const edges::DynamicThreshold& threshold) {
  return search == ClickSearch::kRound ? find_round<S>(model, field, u_px, v_px)
                                       : bisect<S>(model, field, u_px, v_px, threshold);
}

#define TUBESIGHT_INSTANTIATE(S)                                                               \
  template ClickedTube find_circle<S>(const TrackingModel<S>&, const FieldView&, std::int32_t, \
                                      std::int32_t);                                           \
  template ClickedTube find_clicked_tube<S>(const TrackingModel<S>&, const FieldView&,         \
                                            std::int32_t, std::int32_t, ClickSearch,           \
                                            const edges::DynamicThreshold&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
