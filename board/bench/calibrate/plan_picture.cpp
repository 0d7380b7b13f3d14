#include "board/bench/calibrate/plan_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/overlay/painter.h"
#include "core/overlay/palette.h"
#include "drivers/files/png_writer.h"

namespace tubesight::board {
namespace {

using core::overlay::Painter;
using core::overlay::PixelPoint;
using core::overlay::Rgb;
namespace palette = core::overlay::palette;

constexpr std::int32_t kSide_px = 800;
constexpr std::int32_t kMargin_px = 40;
constexpr std::int32_t kLine_px = 14;
constexpr double kMissScale = 200.0;  // a tenth of a millimetre is to be seen
constexpr double kReddest_mm = 1.25;

/// From the sheet to the picture.
class Plan {
 public:
  explicit Plan(const PlanPicture& picture) {
    least_ = most_ = picture.places.empty() ? picture.marks[0].at_mm : picture.places[0].at_mm;
    const auto take = [&](const Eigen::Vector2d& at) {
      least_ = least_.cwiseMin(at);
      most_ = most_.cwiseMax(at);
    };
    for (const PlanPlace& place : picture.places) {
      take(place.at_mm);
    }
    for (const PlanPoint& point : picture.marks) {
      take(point.at_mm);
    }
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
  [[nodiscard]] std::int32_t height_px() const { return at(least_).v_px + kMargin_px; }

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
std::int32_t half_box_px(const std::vector<PlanPlace>& places, const Plan& plan) {
  double least = 1e9;
  for (std::size_t i = 1; i < places.size(); ++i) {
    least = std::min(least, (places[i].at_mm - places[0].at_mm).norm());
  }
  return std::clamp(static_cast<std::int32_t>(0.45 * least * plan.scale()), 1, 40);
}

void draw_mark(Painter& painter, const PlanPoint& point, const Plan& plan) {
  const PixelPoint here = plan.at(point.at_mm);
  switch (point.mark) {
    case PlanMark::kLeftOut: painter.diagonal_cross(here, 9, 3, palette::kRow); break;
    case PlanMark::kBase: painter.cross_hair(here, 4, 14, 3, palette::kTool); break;
    case PlanMark::kNext:
      painter.circle(here, 10, palette::kPlug);
      painter.circle(here, 11, palette::kPlug);
      break;
    case PlanMark::kPair:
    case PlanMark::kCompared:
      painter.line(here, plan.at(point.at_mm + kMissScale * point.miss_mm), 2, palette::kWhite);
      if (point.left_mm) {
        painter.line(here, plan.at(point.at_mm + kMissScale * *point.left_mm), 3, palette::kUsed);
      }
      painter.fill({here.u_px - 3, here.v_px - 3, here.u_px + 3, here.v_px + 3},
                   point.mark == PlanMark::kPair ? palette::kColumn : palette::kUnknown);
      break;
  }
  painter.text({here.u_px + 8, here.v_px - 10}, point.name, 1, palette::kWhite);
}

}  // namespace

bool write_plan(const std::string& path, const PlanPicture& picture, std::string& message) {
  const Plan plan(picture);
  const std::int32_t caption = plan.height_px();
  const std::int32_t foot =
      caption + kLine_px * static_cast<std::int32_t>(picture.caption.size() + 1);
  core::RgbImageView view;
  view.width_px = plan.width_px();
  view.height_px = foot + picture.foot.height_px;
  view.stride_bytes = 3 * view.width_px;
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(view.stride_bytes) *
                                   static_cast<std::size_t>(view.height_px));
  view.pixels = pixels.data();
  Painter painter(view);
  painter.fill({0, 0, view.width_px - 1, view.height_px - 1}, palette::kBlack);
  const std::int32_t half = half_box_px(picture.places, plan);
  for (const PlanPlace& place : picture.places) {
    const PixelPoint here = plan.at(place.at_mm);
    painter.fill({here.u_px - half, here.v_px - half, here.u_px + half, here.v_px + half},
                 colour_of(place.sigma_mm));
  }
  for (const PlanPlace& place : picture.places) {
    if (!place.arrow_mm.isZero()) {
      painter.line(plan.at(place.at_mm), plan.at(place.at_mm + kMissScale * place.arrow_mm), 1,
                   palette::kCaption);
    }
  }
  for (const PlanPoint& point : picture.marks) {
    draw_mark(painter, point, plan);
  }
  std::int32_t line = caption;
  for (const std::string& words : picture.caption) {
    painter.text({8, line}, words, 1, palette::kWhite);
    line += kLine_px;
  }
  if (picture.foot.draw) {
    picture.foot.draw(painter, foot);
  }
  return drivers::write_png(path, view, message).has_value();
}

}  // namespace tubesight::board
