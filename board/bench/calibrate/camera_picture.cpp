#include "board/bench/calibrate/camera_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/overlay/painter.h"
#include "core/overlay/palette.h"
#include "drivers/files/decimal.h"
#include "drivers/files/png_writer.h"

namespace tubesight::board {
namespace {

using core::PixelBox;
using core::calibration::CalibrationView;
using core::calibration::SeenDot;
using core::overlay::Painter;
using core::overlay::PixelPoint;
using core::overlay::Rgb;
namespace palette = core::overlay::palette;

constexpr std::int32_t kWidth_px = 900;
constexpr std::int32_t kMargin_px = 10;
constexpr std::int32_t kLine_px = 14;
constexpr std::int32_t kTilesInARow = 3;
constexpr std::int32_t kThumb_px = (kWidth_px - (kTilesInARow + 1) * kMargin_px) / kTilesInARow;
constexpr double kArrow_px = 14.0;  // of a residual as large as their RMS

/// How well a map is known: a colour each for some values, those where the verdict changes among
/// them; between them mixed by the logarithm.
struct Shade {
  double at_px;
  Rgb colour;
  const char* words;
};
constexpr std::array<Shade, 7> kShades = {{{0.02, {0, 84, 24}, "0.02 px"},
                                           {0.05, {24, 116, 24}, "0.05: base"},
                                           {0.1, {92, 116, 0}, "0.10"},
                                           {0.15, {132, 108, 0}, "0.15: pose"},
                                           {0.4, {144, 76, 0}, "0.4"},
                                           {1.0, {144, 40, 0}, "1: tracking"},
                                           {4.0, {96, 0, 40}, "4 px"}}};

/// Each view's own, so that dots of the large panel can be told apart.
constexpr std::array<Rgb, 6> kViewColours = {{{255, 255, 255},
                                              {255, 224, 32},
                                              {96, 200, 255},
                                              {255, 150, 220},
                                              {170, 255, 150},
                                              {255, 170, 80}}};
Rgb colour_of_view(std::int32_t view) {
  return kViewColours[static_cast<std::size_t>(view) % kViewColours.size()];
}

/// From the camera's picture to a panel.
struct Panel {
  PixelPoint corner;
  double scale = 1.0;

  [[nodiscard]] PixelPoint at(const Eigen::Vector2d& pixel) const {
    return {corner.u_px + static_cast<std::int32_t>(std::lround(scale * (pixel.x() + 0.5))),
            corner.v_px + static_cast<std::int32_t>(std::lround(scale * (pixel.y() + 0.5)))};
  }
};

class CameraSheet {
 public:
  explicit CameraSheet(const CameraPicture& picture)
      : picture_(picture),
        sensor_(picture.data.sensor),
        map_{{kMargin_px, kMargin_px}, (kWidth_px - 2 * kMargin_px) / sensor_.width_px},
        map_height_px_(static_cast<std::int32_t>(map_.scale * sensor_.height_px)),
        tile_scale_(kThumb_px / sensor_.width_px),
        tile_height_px_(static_cast<std::int32_t>(tile_scale_ * sensor_.height_px)),
        legend_px_(map_.corner.v_px + map_height_px_ + 6) {
    const std::int32_t lines = (picture.data.views.size() + kTilesInARow - 1) / kTilesInARow;
    tiles_px_ = legend_px_ + (static_cast<std::int32_t>(picture.caption.size()) + 3) * kLine_px +
                kMargin_px;
    view_.width_px = kWidth_px;
    view_.height_px = tiles_px_ + lines * (tile_height_px_ + 2 * kLine_px + 4);
    view_.stride_bytes = 3 * kWidth_px;
    pixels_.resize(static_cast<std::size_t>(view_.stride_bytes) *
                   static_cast<std::size_t>(view_.height_px));
    view_.pixels = pixels_.data();
    painter_.emplace(view_);
    const double rms_px = picture.outcome.fit.rms_px;
    if (rms_px > 0.0) {
      // 1, 2 or 5 times a power of ten, so that a ruler does.
      const double wanted = kArrow_px / (rms_px * map_.scale);
      const double ten = std::pow(10.0, std::floor(std::log10(wanted)));
      arrows_ = std::max(1.0, ten * (wanted < 2.0 * ten ? 1.0 : wanted < 5.0 * ten ? 2.0 : 5.0));
    }
  }

  bool write(const std::string& path, std::string& message) {
    painter_->fill({0, 0, view_.width_px - 1, view_.height_px - 1}, palette::kBlack);
    draw_map();
    for (std::int32_t v = 0; v < picture_.data.views.size(); ++v) {
      draw_residuals(v);
      draw_tile(v);
    }
    draw_worst();
    draw_words();
    return drivers::write_png(path, view_, message).has_value();
  }

 private:
  [[nodiscard]] bool known() const { return picture_.outcome.map.rms_px > 0.0; }

  void draw_map() {
    constexpr std::int32_t kBlock_px = 6;
    const std::int32_t right = kWidth_px - kMargin_px - 1;
    const std::int32_t bottom = map_.corner.v_px + map_height_px_ - 1;
    for (std::int32_t v = map_.corner.v_px; v <= bottom; v += kBlock_px) {
      for (std::int32_t u = map_.corner.u_px; u <= right; u += kBlock_px) {
        const Eigen::Vector2d pixel((u + 0.5 * kBlock_px - map_.corner.u_px) / map_.scale,
                                    (v + 0.5 * kBlock_px - map_.corner.v_px) / map_.scale);
        const PixelBox block{u, v, std::min(u + kBlock_px - 1, right),
                             std::min(v + kBlock_px - 1, bottom)};
        painter_->fill(block, colour_at(pixel));
      }
    }
  }

  [[nodiscard]] Rgb colour_at(const Eigen::Vector2d& pixel) const {
    if (!known()) {
      return {40, 40, 40};
    }
    const double sigma_px = core::calibration::map_sigma_px(
        sensor_, picture_.state.camera, picture_.outcome.fit.camera_covariance, pixel);
    std::size_t next = 1;
    while (next + 1 < kShades.size() && sigma_px > kShades[next].at_px) {
      ++next;
    }
    const Shade& from = kShades[next - 1];
    const Shade& to = kShades[next];
    const double share =
        std::clamp(std::log(sigma_px / from.at_px) / std::log(to.at_px / from.at_px), 0.0, 1.0);
    const auto mix = [share](std::uint8_t a, std::uint8_t b) {
      return static_cast<std::uint8_t>(std::lround(a + share * (b - a)));
    };
    return {mix(from.colour.red, to.colour.red), mix(from.colour.green, to.colour.green),
            mix(from.colour.blue, to.colour.blue)};
  }

  void draw_residuals(std::int32_t v) {
    const CalibrationView& view = picture_.data.views[v];
    for (std::int32_t i = view.first; i < view.first + view.count; ++i) {
      const SeenDot& dot = picture_.data.dots[i];
      const PixelPoint here = map_.at(dot.seen_px);
      if (!dot.used) {
        painter_->diagonal_cross(here, 7, 2, palette::kRow);
        continue;
      }
      painter_->line(here, map_.at(dot.seen_px + arrows_ * dot.residual_px), 1, colour_of_view(v));
      painter_->fill({here.u_px - 1, here.v_px - 1, here.u_px + 1, here.v_px + 1},
                     colour_of_view(v));
    }
  }

  void draw_worst() {
    if (!known()) {
      return;
    }
    const core::calibration::MapUncertainty& map = picture_.outcome.map;
    const PixelPoint here = map_.at({map.worst_u_px, map.worst_v_px});
    const PixelPoint inside{
        std::clamp(here.u_px, kMargin_px + 12, kWidth_px - kMargin_px - 13),
        std::clamp(here.v_px, map_.corner.v_px + 12, map_.corner.v_px + map_height_px_ - 13)};
    painter_->circle(inside, 10, palette::kPlug);
    painter_->circle(inside, 11, palette::kPlug);
  }

  void draw_tile(std::int32_t v) {
    const CalibrationView& view = picture_.data.views[v];
    const std::int32_t column = v % kTilesInARow;
    const Panel tile{{kMargin_px + column * (kThumb_px + kMargin_px),
                      tiles_px_ + (v / kTilesInARow) * (tile_height_px_ + 2 * kLine_px + 4)},
                     tile_scale_};
    draw_thumb(picture_.views[static_cast<std::size_t>(v)], tile);
    double squares = 0.0;
    const PixelPoint first = tile.at(picture_.data.dots[view.first].seen_px);
    for (std::int32_t i = view.first; i < view.first + view.count; ++i) {
      const SeenDot& dot = picture_.data.dots[i];
      const PixelPoint here = tile.at(dot.seen_px);
      squares += dot.residual_px.squaredNorm();
      painter_->fill({here.u_px - 1, here.v_px - 1, here.u_px + 1, here.v_px + 1},
                     dot.used ? palette::kUsed : palette::kRow);
      if (std::abs(dot.place_mm.y() - picture_.data.dots[view.first].place_mm.y()) < 1e-6) {
        painter_->line(first, here, 1, palette::kRow);  // the first line of dots
      }
    }
    painter_->circle(first, 5, palette::kRow);
    painter_->outline({tile.corner.u_px, tile.corner.v_px, tile.corner.u_px + kThumb_px - 1,
                       tile.corner.v_px + tile_height_px_ - 1},
                      2, colour_of_view(v));
    const PixelPoint below{tile.corner.u_px, tile.corner.v_px + tile_height_px_ + 3};
    painter_->text(below, readable(picture_.views[static_cast<std::size_t>(v)].name), 1,
                   palette::kWhite);
    std::string words;
    if (view.staged) {
      drivers::print(words, "height %.3f mm, ", view.height_mm);
    }
    drivers::print(words, "%d dots, %.4f px RMS", view.count,
                   std::sqrt(squares / std::max(1, view.count)));
    painter_->text({below.u_px, below.v_px + kLine_px}, words, 1, palette::kCaption);
  }

  /// Its name as far as the tile is wide, in characters that the font has.
  [[nodiscard]] static std::string readable(const std::string& name) {
    constexpr std::size_t kMost = kThumb_px / 6;
    std::string words = name.size() > kMost ? name.substr(name.size() - kMost) : name;
    std::replace(words.begin(), words.end(), '_', '-');
    return words;
  }

  /// Darkened, so that what is drawn on it shows.
  void draw_thumb(const ViewThumb& thumb, const Panel& tile) {
    for (std::int32_t v = 0; v < std::min(thumb.height_px, tile_height_px_); ++v) {
      for (std::int32_t u = 0; u < std::min(thumb.width_px, kThumb_px); ++u) {
        const std::uint8_t grey =
            thumb.grey[static_cast<std::size_t>(v) * static_cast<std::size_t>(thumb.width_px) +
                       static_cast<std::size_t>(u)];
        const auto dim = static_cast<std::uint8_t>(20 + grey / 2);
        painter_->pixel({tile.corner.u_px + u, tile.corner.v_px + v}, {dim, dim, dim});
      }
    }
  }

  void draw_words() {
    std::int32_t u = kMargin_px;
    painter_->text({u, legend_px_ + 2}, "map known to", 1, palette::kWhite);
    u += 90;
    for (const Shade& shade : kShades) {
      painter_->fill({u, legend_px_, u + 18, legend_px_ + 11}, shade.colour);
      painter_->text({u + 23, legend_px_ + 2}, shade.words, 1, palette::kWhite);
      u += 112;
    }
    std::int32_t line = legend_px_ + kLine_px + 4;
    std::string words;
    drivers::print(words,
                   "dots of all views with their residuals %.0f times as long, red crosses: left "
                   "out, ring: the map is known least",
                   arrows_);
    painter_->text({kMargin_px, line}, words, 1, palette::kWhite);
    for (const std::string& more : picture_.caption) {
      line += kLine_px;
      painter_->text({kMargin_px, line}, more, 1, palette::kWhite);
    }
  }

  const CameraPicture& picture_;
  const core::calibration::Sensor& sensor_;
  Panel map_;
  std::int32_t map_height_px_;
  double tile_scale_;
  std::int32_t tile_height_px_;
  std::int32_t legend_px_;
  std::int32_t tiles_px_ = 0;
  double arrows_ = 1.0;
  core::RgbImageView view_;
  std::vector<std::uint8_t> pixels_;
  std::optional<Painter> painter_;
};

}  // namespace

ViewThumb make_thumb(const std::string& name, const core::picture::AveragedPicture& picture) {
  ViewThumb thumb;
  thumb.name = name;
  thumb.width_px = kThumb_px;
  thumb.height_px = std::max(1, picture.height_px * kThumb_px / picture.width_px);
  thumb.grey.reserve(static_cast<std::size_t>(thumb.width_px) *
                     static_cast<std::size_t>(thumb.height_px));
  for (std::int32_t v = 0; v < thumb.height_px; ++v) {
    for (std::int32_t u = 0; u < thumb.width_px; ++u) {
      thumb.grey.push_back(static_cast<std::uint8_t>(
          std::min(255, picture.at(u * picture.width_px / thumb.width_px,
                                   v * picture.height_px / thumb.height_px) /
                            core::picture::kGreyScale)));
    }
  }
  return thumb;
}

bool write_camera_picture(const std::string& path, const CameraPicture& picture,
                          std::string& message) {
  return CameraSheet(picture).write(path, message);
}

}  // namespace tubesight::board
