#include "core/tracking/candidates.h"

#include <algorithm>
#include <array>

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/tracking/projection.h"

namespace tubesight::core::tracking {
namespace {

// The part of the lattice that may show in the window.
template <Scalar S>
struct Block {
  std::array<std::int32_t, 2> low{0, 0};  // lattice coordinates around the anchor
  std::array<std::int32_t, 2> high{0, 0};
  Vector2<Ratio<S>> least{};  // a box around the window on the image plane at unit distance
  Vector2<Ratio<S>> most{};
};

template <Scalar S>
Block<S> block_in_window(const TrackingModel<S>& model, const SheetPose<S>& pose) {
  const auto& lattice = model.lattice.parameters();
  const std::int32_t middle = (model.window.left + model.window.right) / 2;
  const std::int32_t half = (model.window.top + model.window.bottom) / 2;
  const std::array<std::array<std::int32_t, 2>, 8> border{
      {{model.window.left, model.window.top},
       {middle, model.window.top},
       {model.window.right, model.window.top},
       {model.window.left, half},
       {model.window.right, half},
       {model.window.left, model.window.bottom},
       {middle, model.window.bottom},
       {model.window.right, model.window.bottom}}};
  Block<S> block;
  bool first = true;
  constexpr std::int32_t kMost = 31;
  for (const auto& [u, v] : border) {
    const Vector2<Px<S>> pixel{from_scaled<Px<S>>(u, 0), from_scaled<Px<S>>(v, 0)};
    const auto plane = model.camera.to_plane(pixel);
    block.least = first ? plane
                        : Vector2<Ratio<S>>{std::min(block.least.x, plane.x),
                                            std::min(block.least.y, plane.y)};
    block.most =
        first ? plane
              : Vector2<Ratio<S>>{std::max(block.most.x, plane.x), std::max(block.most.y, plane.y)};
    first = false;
    const auto point = to_sheet<S>(model, pose, pixel);
    for (std::size_t i = 0; i < 2; ++i) {
      // A border that looks past the sheet's horizon: as far as the block goes.
      const std::int32_t coordinate =
          point ? to_scaled(narrow<Mm<S>>(product(lattice.inverse[i].x, point->x) +
                                          product(lattice.inverse[i].y, point->y)),
                            0)
                : kMost;
      const std::int32_t lowest = point ? coordinate : -kMost;
      block.low[i] = std::max(std::min(block.low[i], lowest - 1), -kMost);
      block.high[i] = std::min(std::max(block.high[i], coordinate + 1), kMost);
    }
  }
  // The window's border is bent on the image plane; between the points looked at it strays by less.
  const Ratio<S> slack = constant<Ratio<S>>(1.0 / 32.0);
  block.least = block.least - Vector2<Ratio<S>>{slack, slack};
  block.most = block.most + Vector2<Ratio<S>>{slack, slack};
  return block;
}

// Which addresses lie within the numbers' range, seen from anchor and camera: a sheet that tilts
// away reaches out of it long before a block ends.
template <Scalar S>
class NumberRange {
 public:
  NumberRange(const TrackingModel<S>& model, const SheetPose<S>& pose, TubeAddress from)
      : start_(model.lattice.offset(pose.anchor, from)), origin_(pose.origin + pose.along(start_)) {
    const auto& basis = model.lattice.parameters().basis;
    for (std::size_t k = 0; k < 2; ++k) {
      local_[k] = model.lattice.offset(
          pose.anchor, {pose.anchor.row + basis[k].row, pose.anchor.column + basis[k].column});
      step_[k] = pose.along(local_[k]);
    }
  }

  /// Whether it holds i and j steps of the basis from `from`. A region without dents: what lies
  /// between is in it, too.
  [[nodiscard]] bool holds(std::int32_t i, std::int32_t j) const {
    using M = Mm<S>;
    const M rows = from_scaled<M>(i, 0);
    const M columns = from_scaled<M>(j, 0);
    // As products: 31 steps of a metre each way fit.
    const auto most = product(constant<M>(2000.0), M(1));
    const auto inside = [&](M start, M row, M column) {
      const auto at = product(start, M(1)) + product(row, rows) + product(column, columns);
      return at < most && -at < most;
    };
    return inside(start_.x, local_[0].x, local_[1].x) &&
           inside(start_.y, local_[0].y, local_[1].y) &&
           inside(origin_.x, step_[0].x, step_[1].x) && inside(origin_.y, step_[0].y, step_[1].y) &&
           inside(origin_.z, step_[0].z, step_[1].z);
  }

  /// Leaves of row i what it holds; nothing: `first` is beyond `last`.
  void cut(std::int32_t i, std::int32_t& first, std::int32_t& last) const {
    while (first <= last && !holds(i, first)) {
      ++first;
    }
    while (first < last && !holds(i, last)) {
      --last;
    }
  }

  [[nodiscard]] bool holds(const Block<S>& block) const {
    return holds(block.low[0], block.low[1]) && holds(block.low[0], block.high[1]) &&
           holds(block.high[0], block.low[1]) && holds(block.high[0], block.high[1]);
  }

 private:
  Vector2<Mm<S>> start_{};
  Vector3<Mm<S>> origin_{};
  std::array<Vector2<Mm<S>>, 2> local_{};
  std::array<Vector3<Mm<S>>, 2> step_{};
};

template <Scalar S>
bool in_box(const Block<S>& block, const Vector2<Ratio<S>>& point) {
  return point.x >= block.least.x && point.x <= block.most.x && point.y >= block.least.y &&
         point.y <= block.most.y;
}

// Keeps the list sorted by distance and within its capacity.
template <typename List, Scalar S>
void insert(List& list, const Candidate<S>& candidate) {
  if (list.full()) {
    if (list[list.size() - 1].distance2_px <= candidate.distance2_px) {
      return;
    }
    list.truncate(list.size() - 1);
  }
  static_cast<void>(list.try_push_back(candidate));
  auto* place = list.end() - 1;
  while (place != list.begin() && candidate.distance2_px < (place - 1)->distance2_px) {
    *place = *(place - 1);
    --place;
  }
  *place = candidate;
}

// Puts a site into the lists that its state by the settings belongs to.
template <Scalar S>
void sort_in(const TrackingModel<S>& model, const tubesheet::SheetMap& map,
             const SheetPose<S>& pose, Candidate<S>& site, CandidateList<S>& candidates,
             SiteList<S>* closed) {
  site.state = map.state(site.address);
  if (site.state == TubeState::kAbsent && closed == nullptr) {
    return;
  }
  site.local = model.lattice.offset(pose.anchor, site.address);
  if (site.state != TubeState::kOpen && closed != nullptr) {
    insert(*closed, site);
  }
  if (site.state != TubeState::kAbsent) {
    insert(candidates, site);
  }
}

// Adds the addresses of the window that are whole steps of the basis from `first`.
template <Scalar S>
void list_from(const TrackingModel<S>& model, const tubesheet::SheetMap& map,
               const SheetPose<S>& pose, const Block<S>& block, TubeAddress first,
               CandidateList<S>& candidates, SiteList<S>* closed) {
  const auto& basis = model.lattice.parameters().basis;
  const std::int32_t optimum_u = to_scaled(model.optimum_px.x, 0);
  const std::int32_t optimum_v = to_scaled(model.optimum_px.y, 0);
  const auto address_at = [&](std::int32_t i, std::int32_t j) {
    return TubeAddress{first.row + i * basis[0].row + j * basis[1].row,
                       first.column + i * basis[0].column + j * basis[1].column};
  };
  const auto place = [&](std::int32_t i, std::int32_t j) {
    return pose.origin + pose.along(model.lattice.offset(pose.anchor, address_at(i, j)));
  };
  const NumberRange<S> range(model, pose, first);
  const bool whole = range.holds(block);
  const Vector3<Mm<S>> step = place(0, 1) - place(0, 0);
  for (std::int32_t i = block.low[0]; i <= block.high[0]; ++i) {
    std::int32_t low = block.low[1];
    std::int32_t high = block.high[1];
    if (!whole) {
      range.cut(i, low, high);
    }
    if (low > high) {
      continue;
    }
    Vector3<Mm<S>> center = place(i, low);
    for (std::int32_t j = low; j <= high; ++j) {
      if (j > low) {
        center = center + step;
      }
      const auto plane = to_plane<S>(center);
      if (!plane || !in_box<S>(block, *plane)) {
        continue;
      }
      const auto pixel = model.camera.to_pixel(*plane);
      if (!pixel) {
        continue;
      }
      const std::int32_t u = to_scaled(pixel->x, 0);
      const std::int32_t v = to_scaled(pixel->y, 0);
      if (u < model.window.left || u > model.window.right || v < model.window.top ||
          v > model.window.bottom) {
        continue;
      }
      Candidate<S> candidate;
      candidate.address = address_at(i, j);
      candidate.center_px = *pixel;
      candidate.distance2_px =
          (u - optimum_u) * (u - optimum_u) + (v - optimum_v) * (v - optimum_v);
      sort_in<S>(model, map, pose, candidate, candidates, closed);
    }
  }
}

}  // namespace

template <Scalar S>
void list_candidates(const TrackingModel<S>& model, const tubesheet::SheetMap& map,
                     const SheetPose<S>& pose, CandidateList<S>& candidates, SiteList<S>* closed) {
  candidates.clear();
  if (closed != nullptr) {
    closed->clear();
  }
  Block<S> block = block_in_window<S>(model, pose);
  list_from<S>(model, map, pose, block, pose.anchor, candidates, closed);
  if (model.lattice.parameters().two_kinds) {
    // Half a step of the basis off at most, either way.
    for (std::size_t i = 0; i < 2; ++i) {
      --block.low[i];
      ++block.high[i];
    }
    list_from<S>(model, map, pose, block, model.lattice.other_kind(pose.anchor), candidates,
                 closed);
  }
}

#define TUBESIGHT_INSTANTIATE(S)                                                        \
  template void list_candidates<S>(const TrackingModel<S>&, const tubesheet::SheetMap&, \
                                   const SheetPose<S>&, CandidateList<S>&, SiteList<S>*);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
