#include "board/bench/calibrate/base_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/overlay/painter.h"
#include "core/overlay/palette.h"
#include "drivers/files/decimal.h"
#include "drivers/files/png_writer.h"

namespace tubesight::board {
namespace {

using core::overlay::Painter;
using core::overlay::PixelPoint;
using core::overlay::Rgb;
namespace palette = core::overlay::palette;

constexpr std::int32_t kSide_px = 800;
constexpr std::int32_t kMargin_px = 40;
constexpr std::int32_t kCaption_px = 76;
constexpr double kMissScale = 200.0;  // a tenth of a millimetre is to be seen
constexpr double kReddest_mm = 1.25;

/// From the sheet to the picture.
class Plan {
 public:
  Plan(const BaseReport& report, std::span<const Eigen::Vector2d> places) {
    least_ = most_ = places[0];
    const auto take = [&](const Eigen::Vector2d& at) {
      least_ = least_.cwiseMin(at);
      most_ = most_.cwiseMax(at);
    };
    for (const Eigen::Vector2d& place : places) {
      take(place);
    }
    for (const auto& pair : report.pairs) {
      take(pair.T_sheet_tool.translation_mm().head<2>());
    }
    take(report.base.fit.pose.T_sheet_base.translation_mm().head<2>());
    scale_ = (kSide_px - 2 * kMargin_px) / std::max(1.0, (most_ - least_).maxCoeff());
  }
  [[nodiscard]] PixelPoint at(const Eigen::Vector2d& place) const {
    return {kMargin_px + static_cast<std::int32_t>(std::lround(scale_ * (place.x() - least_.x()))),
            kMargin_px + static_cast<std::int32_t>(std::lround(scale_ * (most_.y() - place.y())))};
  }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] std::int32_t width_px() const {
    return std::max(kSide_px * 3 / 4, at({most_.x(), least_.y()}).u_px + kMargin_px);
  }
  [[nodiscard]] std::int32_t height_px() const {
    return at(least_).v_px + kMargin_px + kCaption_px;
  }

 private:
  Eigen::Vector2d least_;
  Eigen::Vector2d most_;
  double scale_ = 1.0;
};

Rgb colour_of(double sigma_mm) {
  const double share = std::clamp(sigma_mm / kReddest_mm, 0.0, 1.0);
  const auto part = [](double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 150.0)));
  };
  return {part(300.0 * share), part(300.0 * (1.0 - share)), 20};
}

/// Half the least distance between places, so that their boxes fill the plan.
std::int32_t half_box_px(std::span<const Eigen::Vector2d> places, const Plan& plan) {
  double least = 1e9;
  for (std::size_t i = 1; i < places.size(); ++i) {
    least = std::min(least, (places[i] - places[0]).norm());
  }
  return std::clamp(static_cast<std::int32_t>(0.45 * least * plan.scale()), 1, 40);
}

void draw_pairs(Painter& painter, const BaseReport& report, const Plan& plan) {
  for (std::int32_t i = 0; i < report.outcomes.size(); ++i) {
    const Eigen::Vector2d place = report.pairs[i].T_sheet_tool.translation_mm().head<2>();
    const PixelPoint here = plan.at(place);
    if (report.outcomes[i].outlier) {
      painter.diagonal_cross(here, 9, 3, palette::kRow);
    } else {
      const Eigen::Vector2d miss = report.outcomes[i].place_mm.head<2>();
      painter.line(here, plan.at(place + kMissScale * miss), 2, palette::kWhite);
      painter.fill({here.u_px - 3, here.v_px - 3, here.u_px + 3, here.v_px + 3},
                   report.pairs[i].use ? palette::kColumn : palette::kUnknown);
    }
    painter.text({here.u_px + 8, here.v_px - 10}, report.names[static_cast<std::size_t>(i)], 1,
                 palette::kWhite);
  }
}

void draw_caption(Painter& painter, const BaseReport& report, std::int32_t top) {
  std::string line;
  drivers::print(line, "tool across %.2f mm RMS (one sigma), %.2f at worst (green 0, red 1.25 mm)",
                 report.base.mean.across_mm, report.base.worst.across_mm);
  painter.text({8, top}, line, 1, palette::kWhite);
  painter.text({8, top + 14}, "yellow: pairs, with their misses 200 times as long", 1,
               palette::kColumn);
  painter.text({8, top + 28}, "red cross: left out", 1, palette::kRow);
  painter.text({8, top + 42}, "blue: the base", 1, palette::kTool);
  painter.text({8, top + 56}, "ring: where the next pair would help most", 1, palette::kPlug);
}

}  // namespace

bool write_base_picture(const std::string& path, const BaseReport& report,
                        std::span<const Eigen::Vector2d> places, std::string& message) {
  const Plan plan(report, places);
  core::RgbImageView view;
  view.width_px = plan.width_px();
  view.height_px = plan.height_px();
  view.stride_bytes = 3 * view.width_px;
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(view.stride_bytes) *
                                   static_cast<std::size_t>(view.height_px));
  view.pixels = pixels.data();
  Painter painter(view);
  painter.fill({0, 0, view.width_px - 1, view.height_px - 1}, palette::kBlack);
  const std::int32_t half = half_box_px(places, plan);
  for (const Eigen::Vector2d& place : places) {
    const PixelPoint here = plan.at(place);
    painter.fill({here.u_px - half, here.v_px - half, here.u_px + half, here.v_px + half},
                 colour_of(core::calibration::deviation_at(report.base, place).across_mm));
  }
  draw_pairs(painter, report, plan);
  const PixelPoint base = plan.at(report.base.fit.pose.T_sheet_base.translation_mm().head<2>());
  painter.cross_hair(base, 4, 14, 3, palette::kTool);
  const PixelPoint next = plan.at(report.next.at_mm);
  painter.circle(next, 10, palette::kPlug);
  painter.circle(next, 11, palette::kPlug);
  draw_caption(painter, report, view.height_px - kCaption_px);
  return drivers::write_png(path, view, message).has_value();
}

}  // namespace tubesight::board
