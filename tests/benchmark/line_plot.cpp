#include "tests/benchmark/line_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/image_view.h"
#include "drivers/files/png_writer.h"

namespace tubesight::benchmark {
namespace {

using core::overlay::Painter;
using core::overlay::PixelPoint;
using core::overlay::Rgb;

constexpr std::int32_t kWidth = 480;
constexpr std::int32_t kHeight = 300;
constexpr std::int32_t kLeft = 64;
constexpr std::int32_t kRight = 20;
constexpr std::int32_t kTop = 34;
constexpr std::int32_t kBottom = 46;
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

void draw_panel(Painter& painter, const Panel& panel, PixelPoint corner) {
  const Axes axes = axes_of(panel, corner);
  draw_grid(painter, panel, axes);
  std::int32_t line = 0;
  for (const Series& series : panel.series) {
    for (std::size_t i = 0; i < series.points.size(); ++i) {
      const PixelPoint here = axes.at(series.points[i][0], series.points[i][1]);
      painter.fill({here.u_px - 2, here.v_px - 2, here.u_px + 2, here.v_px + 2}, series.colour);
      if (!series.joined) {
        painter.line(axes.at(series.points[i][0], 0.0), here, 2, series.colour);
      } else if (i > 0) {
        painter.line(axes.at(series.points[i - 1][0], series.points[i - 1][1]), here, 2,
                     series.colour);
      }
    }
    painter.text({corner.u_px + kLeft + 12, corner.v_px + kTop + 4 + 14 * line}, series.name, 1,
                 series.colour);
    ++line;
  }
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

}  // namespace tubesight::benchmark
