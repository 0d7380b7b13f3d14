#pragma once

namespace tubesight::core::rendering {

// The optics smear an edge: what an edge looks like across is the integral of a bell. The bell is
// 15/16 (1 - t^2)^2 over -1..1: within 2 % of a Gaussian's integral, and a polynomial, which
// vectorises.

/// Half the bell's width over its sigma: sigma^2 = 1/7.
inline constexpr float kBellHalfWidth = 2.6457513F;

/// The shortest half motion blur, in half bell widths, so that the difference quotient holds in
/// float.
inline constexpr float kShortestMotion = 0.06F;

/// The second integral of the bell: 0 below -1, t above 1.
[[nodiscard]] inline float bell_integral(float t) {
  const float low = t < -1.0F ? -1.0F : t;
  const float x = low > 1.0F ? 1.0F : low;
  const float x2 = x * x;
  const float inside = 0.15625F + 0.5F * x + x2 * (0.46875F + x2 * (-0.15625F + 0.03125F * x2));
  return inside + (low - x);
}

/// The integral of the bell: 0 below -1, 1 above 1; what a resting edge looks like across.
struct RestingEdge {
  explicit RestingEdge(float) {}

  /// Share of a pixel's light that comes from the inner side of an edge, 0..1, 0.5 on the edge;
  /// `distance`: signed, from the edge inwards, half bell widths.
  [[nodiscard]] float share(float distance) const {
    const float low = distance < -1.0F ? -1.0F : distance;
    const float t = low > 1.0F ? 1.0F : low;
    const float t2 = t * t;
    return 0.5F + t * (0.9375F + t2 * (-0.625F + 0.1875F * t2));
  }
};

/// An edge that moves during the exposure is averaged over its way, exactly.
struct MovingEdge {
  float half = kShortestMotion;  ///< half the way along the edge's normal, half bell widths
  float scale = 1.0F;            ///< 1 / way

  /// `motion`: half the way, half bell widths.
  explicit MovingEdge(float motion)
      : half(motion < kShortestMotion ? kShortestMotion : motion), scale(0.5F / half) {}

  /// As RestingEdge::share().
  [[nodiscard]] float share(float distance) const {
    // Far from the edge nothing changes; the difference of two large numbers would.
    const float reach = half + 1.5F;
    const float low = distance < -reach ? -reach : distance;
    const float t = low > reach ? reach : low;
    return (bell_integral(t + half) - bell_integral(t - half)) * scale;
  }
};

}  // namespace tubesight::core::rendering
