#include "board/bench/output/line_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/base/image_view.h"
#include "core/overlay/font.h"
#include "drivers/files/png_writer.h"

namespace tubesight::board {
namespace {

using core::PixelBox;
using core::overlay::Painter;
using core::overlay::PixelPoint;
using core::overlay::Rgb;

constexpr std::int32_t kWidth = 480;
constexpr std::int32_t kHeight = 300;
constexpr std::int32_t kLeft = 64;
constexpr std::int32_t kRight = 20;
constexpr std::int32_t kTop = 34;
constexpr std::int32_t kBottom = 46;
constexpr std::int32_t kLegendLine_px = 14;
constexpr Rgb kPaper{255, 255, 255};
constexpr Rgb kInk{40, 40, 40};
constexpr Rgb kGrid{222, 222, 222};

// 1, 2 or 5 times a power of ten, so that about five steps cover the range.
double tick_step(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 5.0)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (range / (factor * power) <= 6.0) {
      return factor * power;
    }
  }
  return 10.0 * power;
}

std::string number(double value) {
  std::array<char, 32> text{};
  static_cast<void>(std::snprintf(text.data(), text.size(), "%.4g", value));
  return text.data();
}

struct Axes {
  double x_max = 0.0;
  double y_max = 0.0;
  PixelPoint corner;

  [[nodiscard]] PixelPoint at(double x, double y) const {
    const double u = kLeft + x / x_max * (kWidth - kLeft - kRight);
    const double v = kHeight - kBottom - y / y_max * (kHeight - kTop - kBottom);
    return {corner.u_px + static_cast<std::int32_t>(std::lround(u)),
            corner.v_px + static_cast<std::int32_t>(std::lround(v))};
  }
};

Axes axes_of(const Panel& panel, PixelPoint corner) {
  Axes axes{1e-12, 1e-12, corner};
  for (const Series& series : panel.series) {
    for (const auto& point : series.points) {
      axes.x_max = std::max(axes.x_max, point[0]);
      axes.y_max = std::max(axes.y_max, point[1]);
    }
  }
  axes.y_max *= 1.1;
  return axes;
}

void draw_grid(Painter& painter, const Panel& panel, const Axes& axes) {
  const double x_step = tick_step(axes.x_max);
  for (double x = 0.0; x <= axes.x_max * 1.0001; x += x_step) {
    painter.line(axes.at(x, 0.0), axes.at(x, axes.y_max), 1, kGrid);
    const PixelPoint foot = axes.at(x, 0.0);
    painter.text({foot.u_px - 8, foot.v_px + 6}, number(x), 1, kInk);
  }
  const double y_step = tick_step(axes.y_max);
  for (double y = 0.0; y <= axes.y_max * 1.0001; y += y_step) {
    painter.line(axes.at(0.0, y), axes.at(axes.x_max, y), 1, kGrid);
    const PixelPoint side = axes.at(0.0, y);
    painter.text({axes.corner.u_px + 10, side.v_px - 4}, number(y), 1, kInk);
  }
  painter.line(axes.at(0.0, 0.0), axes.at(axes.x_max, 0.0), 1, kInk);
  painter.line(axes.at(0.0, 0.0), axes.at(0.0, axes.y_max), 1, kInk);
  painter.text({axes.corner.u_px + kLeft, axes.corner.v_px + 6}, panel.caption, 1, kInk);
  painter.text({axes.corner.u_px + 6, axes.corner.v_px + 20}, panel.y_name, 1, kInk);
  painter.text({axes.corner.u_px + kWidth / 2, axes.corner.v_px + kHeight - 18}, panel.x_name, 1,
               kInk);
}

// Earlier series are wider than later ones, so that those that coincide can all be seen.
void draw_series(Painter& painter, const Series& series, std::int32_t thickness_px,
                 const Axes& axes) {
  const std::int32_t reach = thickness_px / 2 + 1;
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    const PixelPoint here = axes.at(series.points[i][0], series.points[i][1]);
    painter.fill({here.u_px - reach, here.v_px - reach, here.u_px + reach, here.v_px + reach},
                 series.colour);
    if (!series.joined) {
      painter.line(axes.at(series.points[i][0], 0.0), here, thickness_px, series.colour);
    } else if (i > 0) {
      painter.line(axes.at(series.points[i - 1][0], series.points[i - 1][1]), here, thickness_px,
                   series.colour);
    }
  }
}

// How much of the curves runs through a box, in steps of a 64th of the way from point to point.
std::int32_t curves_in(const PixelBox& box, const Panel& panel, const Axes& axes) {
  constexpr int kSteps = 64;
  std::int32_t inside = 0;
  for (const Series& series : panel.series) {
    for (std::size_t i = 0; i < series.points.size(); ++i) {
      const auto& to = series.points[i];
      const std::array<double, 2> foot{to[0], 0.0};
      const auto& from = !series.joined ? foot : series.points[i > 0 ? i - 1 : 0];
      for (int k = 0; k <= kSteps; ++k) {
        const double share = static_cast<double>(k) / kSteps;
        const PixelPoint at =
            axes.at(from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]));
        inside += at.u_px >= box.left && at.u_px <= box.right && at.v_px >= box.top &&
                          at.v_px <= box.bottom
                      ? 1
                      : 0;
      }
    }
  }
  return inside;
}

// The names of the series, in the corner with the least of the curves.
void draw_legend(Painter& painter, const Panel& panel, const Axes& axes) {
  std::int32_t width = 0;
  for (const Series& series : panel.series) {
    width = std::max(width, core::overlay::text_width_px(series.name, 1));
  }
  const std::int32_t height = kLegendLine_px * static_cast<std::int32_t>(panel.series.size());
  const std::int32_t left = axes.corner.u_px + kLeft + 12;
  const std::int32_t right = axes.corner.u_px + kWidth - kRight - 12 - width;
  const std::int32_t top = axes.corner.v_px + kTop + 4;
  const std::int32_t bottom = axes.corner.v_px + kHeight - kBottom - 6 - height;
  PixelPoint best{left, top};
  std::int32_t least = std::numeric_limits<std::int32_t>::max();
  for (const PixelPoint at : {PixelPoint{left, top}, PixelPoint{right, top},
                              PixelPoint{left, bottom}, PixelPoint{right, bottom}}) {
    const std::int32_t inside =
        curves_in({at.u_px - 6, at.v_px - 6, at.u_px + width + 6, at.v_px + height}, panel, axes);
    if (inside < least) {
      least = inside;
      best = at;
    }
  }
  for (const Series& series : panel.series) {
    painter.text(best, series.name, 1, series.colour);
    best.v_px += kLegendLine_px;
  }
}

void draw_panel(Painter& painter, const Panel& panel, PixelPoint corner) {
  const Axes axes = axes_of(panel, corner);
  draw_grid(painter, panel, axes);
  auto thickness = 2 * static_cast<std::int32_t>(panel.series.size());
  for (const Series& series : panel.series) {
    draw_series(painter, series, thickness, axes);
    thickness -= 2;
  }
  draw_legend(painter, panel, axes);
}

}  // namespace

bool write_plot(const std::string& path, const std::vector<Panel>& panels, std::string& message) {
  const auto rows = static_cast<std::int32_t>((panels.size() + 1) / 2);
  core::RgbImageView view;
  view.width_px = 2 * kWidth;
  view.height_px = rows * kHeight;
  view.stride_bytes = 3 * view.width_px;
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(view.stride_bytes) *
                                   static_cast<std::size_t>(view.height_px));
  view.pixels = pixels.data();
  Painter painter(view);
  painter.fill({0, 0, view.width_px - 1, view.height_px - 1}, kPaper);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const auto place = static_cast<std::int32_t>(i);
    draw_panel(painter, panels[i], {place % 2 * kWidth, place / 2 * kHeight});
  }
  return drivers::write_png(path, view, message).has_value();
}

}  // namespace tubesight::board
