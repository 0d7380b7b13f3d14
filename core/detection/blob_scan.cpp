#include "core/detection/blob_scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tubesight::core::detection {
namespace {

/// Keeps a spot, or the better of it and what another threshold showed in its place.
bool keep(const Blob& blob, BlobList& blobs) {
  const double reach = half_axes(blob.ellipse).y();
  for (Blob& other : blobs) {
    if (other.dark == blob.dark &&
        (other.ellipse.center_px - blob.ellipse.center_px).squaredNorm() < 0.25 * reach * reach) {
      const double area =
          std::sqrt(blob.ellipse.shape_px2.determinant() / other.ellipse.shape_px2.determinant());
      if (area > 0.5 && area < 2.0) {
        if (std::abs(blob.fill - 1.0) < std::abs(other.fill - 1.0)) {
          other = blob;
        }
        return true;
      }
    }
  }
  return blobs.try_push_back(blob);
}

}  // namespace

bool BlobScan::scan(const picture::AveragedPicture& picture, const ThresholdMap& thresholds,
                    const BlobLimits& limits, BlobList& blobs) {
  overflown_ = false;
  runs_[0].clear();
  runs_[1].clear();
  active_.clear();
  free_.clear();
  for (std::int32_t i = kMaxParts - 1; i >= 0; --i) {
    static_cast<void>(free_.try_push_back(i));
  }
  for (std::int32_t v = 0; v < picture.height_px; ++v) {
    now_ = 1 - now_;
    collect_runs(picture, thresholds, v);
    join_lines(v);
    finish_parts(v, picture, limits, blobs);
  }
  // What reaches the last line is cut off by it.
  return !overflown_;
}

void BlobScan::collect_runs(const picture::AveragedPicture& picture, const ThresholdMap& thresholds,
                            std::int32_t v) {
  thresholds.line(v, line_);
  RunList& runs = runs_[static_cast<std::size_t>(now_)];
  runs.clear();
  const std::uint16_t* const pixels = picture.line(v);
  Run run{0, 0, 0, pixels[0] < line_[0]};
  for (std::int32_t u = 1; u < picture.width_px; ++u) {
    const bool dark = pixels[u] < line_[static_cast<std::size_t>(u)];
    if (dark != run.dark) {
      run.end = u;
      static_cast<void>(runs.try_push_back(run));
      run = {u, u, 0, dark};
    }
  }
  run.end = picture.width_px;
  static_cast<void>(runs.try_push_back(run));
}

std::int32_t BlobScan::root_of_part(std::int32_t index) {
  while (part(index).parent != index) {
    index = part(index).parent;
  }
  return index;
}

std::int32_t BlobScan::take_part(const Run& run, std::int32_t v) {
  const std::int32_t index = free_[free_.size() - 1];
  free_.truncate(free_.size() - 1);
  static_cast<void>(active_.try_push_back(index));
  Part& taken = part(index);
  taken = {};
  taken.left = run.begin;
  taken.right = run.end - 1;
  taken.top = v;
  taken.parent = index;
  taken.dark = run.dark;
  return index;
}

void BlobScan::add_run(Part& part, const Run& run, std::int32_t v) {
  // Sums of u and u^2 over begin .. end - 1, in closed form.
  const std::int64_t count = run.end - run.begin;
  const std::int64_t last = run.end - 1;
  const auto squares = [](std::int64_t n) { return n * (n + 1) * (2 * n + 1) / 6; };
  const std::int64_t u = (run.begin + last) * count / 2;
  part.area += count;
  part.u += u;
  part.v += count * v;
  part.uu += squares(last) - squares(run.begin - std::int64_t{1});
  part.uv += u * v;
  part.vv += count * v * v;
  part.left = std::min(part.left, run.begin);
  part.right = std::max(part.right, run.end - 1);
  part.bottom = v;
}

/// Gives each run of this line the part of those above it that it touches, joining these.
void BlobScan::join_lines(std::int32_t v) {
  RunList& now = runs_[static_cast<std::size_t>(now_)];
  const RunList& before = runs_[static_cast<std::size_t>(1 - now_)];
  std::int32_t first = 0;
  for (Run& run : now) {
    std::int32_t joined = -1;
    while (first < before.size() && before[first].end <= run.begin) {
      ++first;
    }
    for (std::int32_t k = first; k < before.size() && before[k].begin < run.end; ++k) {
      if (before[k].dark != run.dark) {
        continue;
      }
      const std::int32_t above = root_of_part(before[k].part);
      if (joined >= 0 && above != joined) {
        Part& from = part(above);
        Part& to = part(joined);
        to.area += from.area;
        to.u += from.u;
        to.v += from.v;
        to.uu += from.uu;
        to.uv += from.uv;
        to.vv += from.vv;
        to.left = std::min(to.left, from.left);
        to.right = std::max(to.right, from.right);
        to.top = std::min(to.top, from.top);
        from.parent = joined;
      }
      joined = joined < 0 ? above : joined;
    }
    run.part = joined < 0 ? take_part(run, v) : joined;
    add_run(part(run.part), run, v);
  }
  for (Run& run : now) {
    run.part = root_of_part(run.part);
    part(run.part).bottom = v;
  }
}

/// Judges the parts that this line does not go on with, and frees them.
void BlobScan::finish_parts(std::int32_t v, const picture::AveragedPicture& picture,
                            const BlobLimits& limits, BlobList& blobs) {
  std::int32_t kept = 0;
  for (std::int32_t i = 0; i < active_.size(); ++i) {
    const std::int32_t index = active_[i];
    const Part& here = part(index);
    if (here.parent == index && here.bottom == v) {
      active_[kept++] = index;
      continue;
    }
    if (here.parent == index) {
      judge(here, picture, limits, blobs);
    }
    static_cast<void>(free_.try_push_back(index));
  }
  active_.truncate(kept);
}

void BlobScan::judge(const Part& part, const picture::AveragedPicture& picture,
                     const BlobLimits& limits, BlobList& blobs) {
  const auto area = static_cast<double>(part.area);
  if (area < limits.least_area_px2 || area > limits.most_area_px2 || part.left == 0 ||
      part.top == 0 || part.right == picture.width_px - 1) {
    return;
  }
  Blob blob;
  blob.dark = part.dark;
  const double u = static_cast<double>(part.u) / area;
  const double v = static_cast<double>(part.v) / area;
  // A pixel is a square of its own with a variance of 1/12; a filled ellipse has a quarter of its
  // half axes' squares.
  const double uu = 4.0 * (static_cast<double>(part.uu) / area - u * u + 1.0 / 12.0);
  const double vv = 4.0 * (static_cast<double>(part.vv) / area - v * v + 1.0 / 12.0);
  const double uv = 4.0 * (static_cast<double>(part.uv) / area - u * v);
  blob.ellipse.center_px << u, v;
  blob.ellipse.shape_px2 << uu, uv, uv, vv;
  const double determinant = blob.ellipse.shape_px2.determinant();
  if (!(determinant > 0.0)) {
    return;
  }
  blob.fill = area / (std::numbers::pi * std::sqrt(determinant));
  const Eigen::Vector2d axes = half_axes(blob.ellipse);
  if (blob.fill < limits.least_fill || axes.y() < limits.least_slimness * axes.x()) {
    return;
  }
  overflown_ = !keep(blob, blobs) || overflown_;
}

}  // namespace tubesight::core::detection
