#include "tests/core/overlay/scenes.h"

#include <array>
#include <cstdlib>

#include "core/overlay/overlay.h"

namespace tubesight::tests {
namespace {

using core::ImagePoint;
using core::Sighting;
using core::TubeAddress;
using core::TubeSighting;
using core::TubeState;
using core::overlay::Estimate;
using core::overlay::OverlayInput;

// A lattice seen straight on: simple enough to check a golden picture with a ruler.
struct Lattice {
  TubeAddress first;  // address at (u, v)
  std::int32_t u = 0;
  std::int32_t v = 0;
  std::array<std::int32_t, 2> row_step{};  // in pixels
  std::array<std::int32_t, 2> column_step{};
  std::int32_t radius = 0;

  [[nodiscard]] std::array<std::int32_t, 2> pixel(TubeAddress tube) const {
    const std::int32_t rows = tube.row - first.row;
    const std::int32_t columns = tube.column - first.column;
    return {u + rows * row_step[0] + columns * column_step[0],
            v + rows * row_step[1] + columns * column_step[1]};
  }
  [[nodiscard]] ImagePoint point(TubeAddress tube) const {
    return {pixel(tube)[0] * 65536, pixel(tube)[1] * 65536};
  }
};

constexpr std::int32_t kReach = 9;  // rows and columns to each side of the first

std::vector<std::uint8_t> grey_picture(const Lattice& lattice, std::int32_t width,
                                       std::int32_t height) {
  std::vector<std::uint8_t> grey(static_cast<std::size_t>(width * height));
  for (std::int32_t v = 0; v < height; ++v) {
    for (std::int32_t u = 0; u < width; ++u) {
      // Brighter towards the upper middle, in broad steps.
      const std::int32_t shade = 190 - 20 * (v / 80) - 15 * (std::abs(u - width / 2) / 80);
      grey[static_cast<std::size_t>(v * width + u)] =
          static_cast<std::uint8_t>(shade < 20 ? 20 : shade);
    }
  }
  for (std::int32_t row = -kReach; row <= kReach; ++row) {
    for (std::int32_t column = -kReach; column <= kReach; ++column) {
      const auto [cu, cv] = lattice.pixel({lattice.first.row + row, lattice.first.column + column});
      const std::int32_t r = lattice.radius;
      for (std::int32_t v = cv - r; v <= cv + r; ++v) {
        for (std::int32_t u = cu - r; u <= cu + r; ++u) {
          const bool inside = (u - cu) * (u - cu) + (v - cv) * (v - cv) <= r * r;
          if (inside && u >= 0 && u < width && v >= 0 && v < height) {
            grey[static_cast<std::size_t>(v * width + u)] = 12;
          }
        }
      }
    }
  }
  return grey;
}

// All of the lattice inside a window: some rejected, and one plug.
std::vector<TubeSighting> tubes_in(const Lattice& lattice, const core::PixelBox& window) {
  std::vector<TubeSighting> tubes;
  for (std::int32_t row = -kReach; row <= kReach; ++row) {
    for (std::int32_t column = -kReach; column <= kReach; ++column) {
      const TubeAddress address{lattice.first.row + row, lattice.first.column + column};
      const auto [u, v] = lattice.pixel(address);
      if (u > window.left && u < window.right && v > window.top && v < window.bottom) {
        const bool rejected = row == 1 && column % 2 != 0;
        tubes.push_back(
            {address, lattice.point(address), rejected ? 0 : 8000, row == -1 && column == 1});
      }
    }
  }
  return tubes;
}

Picture draw(const Lattice& lattice, OverlayInput input, std::int32_t width, std::int32_t height) {
  input.tool_rim = core::overlay::HalfSize{lattice.radius, lattice.radius};
  input.aligned_within_um_q8 = 2'500 * 256;
  const std::vector<std::uint8_t> grey = grey_picture(lattice, width, height);
  const std::int32_t whole = core::overlay::overlay_height_px(width, height);
  Picture picture{width, whole,
                  std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * whole))};
  const core::RgbImageView view{picture.bytes.data(), width, whole, 3 * width};
  core::overlay::copy_grey({grey.data(), width, height, width}, view);
  core::overlay::draw_overlay(view, input);
  return picture;
}

// The tracked tube is the one above the guidetube, which is in line with it.
Picture draw_aligned() {
  const Lattice lattice{{40, 60}, 318, 190, {0, 66}, {78, 0}, 27};
  OverlayInput input;
  input.window = core::PixelBox{40, 36, 595, 330};
  input.optimum_px = ImagePoint{330 * 65536, 180 * 65536};
  const auto tubes = tubes_in(lattice, *input.window);
  input.tubes = tubes;
  input.field = 184;
  Sighting& s = input.sighting;
  s.time = core::FieldTime(3'066'666'667);
  s.state = core::TrackState::kTracking;
  s.reason = core::Reason::kNone;
  s.tracked = 31;
  s.primary_known = s.tool_known = s.axis_known = s.aligned = true;
  s.primary = s.tool = {40, 60};
  s.primary_px = s.tool_px = lattice.point({40, 60});
  s.axis_px = {320 * 65536, 188 * 65536};
  s.height_um_q8 = 60'000 * 256;
  s.offset_um_q8 = 550 * 256;
  input.next_row_px = lattice.point({41, 60});
  input.next_column_px = lattice.point({40, 61});
  return draw(lattice, input, 635, 480);
}

// Two tubes left, camera turned by some 90 degrees, guidetube between tubes.
Picture draw_between() {
  const Lattice lattice{{-3, 118}, 300, 170, {72, 8}, {6, -64}, 25};
  OverlayInput input;
  input.window = core::PixelBox{40, 36, 595, 400};
  const std::array<TubeSighting, 2> tubes{
      TubeSighting{{-3, 118}, lattice.point({-3, 118}), 7000, false},
      TubeSighting{{-2, 117}, lattice.point({-2, 117}), 6000, false}};
  input.tubes = tubes;
  input.field = 9;
  Sighting& s = input.sighting;
  s.time = core::FieldTime(150'000'000);
  s.state = core::TrackState::kDegraded;
  s.reason = core::Reason::kFewTubes;
  s.tracked = 2;
  s.primary_known = s.tool_known = s.axis_known = true;
  s.primary = {-3, 118};
  s.primary_px = lattice.point({-3, 118});
  s.tool = {-4, 115};
  s.tool_px = lattice.point({-4, 115});
  s.axis_px = {s.tool_px.u_q16 + 20 * 65536, s.tool_px.v_q16 - 12 * 65536};
  s.height_um_q8 = 74'300 * 256;
  s.offset_um_q8 = 8'120 * 256;
  input.next_row_px = lattice.point({-2, 118});
  input.next_column_px = lattice.point({-3, 119});
  s.judged = true;
  s.residual_px_q16 = 7'000;
  input.news.claim = core::ClaimReply{
      {-4, 116}, core::ClaimVerdict::kContradicted, core::ClaimDoubt::kNone, {-4, 115}, 8};
  input.news.claimed_px = lattice.point({-4, 116});
  return draw(lattice, input, 635, 480);
}

Picture draw_lost() {
  const Lattice lattice{{40, 60}, 318, 190, {0, 66}, {78, 0}, 27};
  OverlayInput input;
  input.window = core::PixelBox{40, 36, 595, 330};
  input.optimum_px = ImagePoint{318 * 65536, 183 * 65536};
  input.field = 1'203;
  input.sighting.time = core::FieldTime(20'050'000'000);
  input.sighting.state = core::TrackState::kLost;
  input.sighting.reason = core::Reason::kJump;
  const auto beside = [&](TubeAddress tube) {
    const ImagePoint centre = lattice.point(tube);
    return ImagePoint{centre.u_q16 + 8 * 65536, centre.v_q16 - 5 * 65536};
  };
  using core::overlay::Click;
  using core::overlay::ClickVerdict;
  const std::array<Click, 3> clicks{Click{beside({40, 60}), {40, 60}, ClickVerdict::kRefused},
                                    Click{beside({41, 60}), {41, 60}, ClickVerdict::kRefused},
                                    Click{beside({40, 60}), {40, 61}, ClickVerdict::kBlamed}};
  input.news.clicks = clicks;
  input.news.refusal = core::StartRefusal::kSameTubeTwice;
  return draw(lattice, input, 635, 480);
}

// What the operator checks after a start: where every tube is expected.
Picture draw_estimates() {
  const Lattice lattice{{40, 60}, 318, 190, {0, 66}, {78, 0}, 27};
  OverlayInput input;
  input.window = core::PixelBox{40, 36, 595, 330};
  const auto tubes = tubes_in(lattice, {200, 100, 450, 300});
  input.tubes = tubes;
  std::vector<Estimate> estimates;
  for (std::int32_t row = 37; row <= 44; ++row) {
    for (std::int32_t column = 56; column <= 64; ++column) {
      const TubeState state = column == 62                ? TubeState::kAbsent
                              : row == 39 && column == 61 ? TubeState::kPlugged
                                                          : TubeState::kOpen;
      estimates.push_back({{row, column}, lattice.point({row, column}), state});
    }
  }
  input.estimates = estimates;
  Sighting& s = input.sighting;
  s.state = core::TrackState::kTracking;
  s.reason = core::Reason::kNone;
  s.tracked = 7;
  s.primary_known = true;
  s.primary = {40, 60};
  s.primary_px = lattice.point({40, 60});
  input.next_row_px = lattice.point({41, 60});
  input.next_column_px = lattice.point({40, 61});
  return draw(lattice, input, 635, 480);
}

// Half the size, marks at the edges.
Picture draw_small() {
  const Lattice lattice{{8, 9}, 20, 30, {0, 40}, {44, 2}, 14};
  OverlayInput input;
  input.window = core::PixelBox{-5, 10, 250, 190};
  const auto tubes = tubes_in(lattice, *input.window);
  input.tubes = tubes;
  Sighting& s = input.sighting;
  s.state = core::TrackState::kWaiting;
  s.reason = core::Reason::kStartRefused;
  s.primary_known = s.tool_known = s.axis_known = true;
  s.primary = {8, 9};
  s.primary_px = lattice.point({8, 9});
  s.tool = {8, 15};
  s.tool_px = lattice.point({8, 15});
  s.offset_um_q8 = 12'345 * 256;
  s.axis_px = s.tool_px;
  input.next_row_px = lattice.point({7, 9});
  input.next_column_px = lattice.point({8, 10});
  return draw(lattice, input, 320, 240);
}

constexpr std::array<Scene, 5> kScenes{{
    {"aligned", 0x25a40944064a65e9U, draw_aligned},
    {"between", 0x30eb3181dfc4a5f1U, draw_between},
    {"estimates", 0xd9acd7ef9cd3b420U, draw_estimates},
    {"lost", 0x5d774d1cea3f06e3U, draw_lost},
    {"small", 0x3a598b1cf4b7d1f6U, draw_small},
}};

}  // namespace

std::span<const Scene> scenes() { return kScenes; }

std::uint64_t digest_of(const Picture& picture) {
  std::uint64_t digest = 0xcbf29ce484222325U;
  for (const std::uint8_t byte : picture.bytes) {
    digest = (digest ^ byte) * 0x100000001b3U;
  }
  return digest;
}

}  // namespace tubesight::tests
