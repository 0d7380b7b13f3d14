#pragma once

#include <array>
#include <cstdint>

#include "core/base/static_vector.h"
#include "core/detection/ellipse.h"
#include "core/detection/threshold_map.h"
#include "core/picture/averaged_picture.h"

namespace tubesight::core::detection {

/// A spot all darker or all brighter than what surrounds it, whose form is that of an ellipse.
struct Blob {
  Ellipse ellipse;    ///< with the moments of the spot's pixels
  double fill = 0.0;  ///< the spot's area over that of the ellipse; 1 where it is one
  bool dark = true;
};

/// Spots of a picture that are kept. A template of 32 x 32 dots, and as many false ones.
inline constexpr std::int32_t kMaxBlobs = 2048;
using BlobList = StaticVector<Blob, kMaxBlobs>;

/// Which spots are kept.
struct BlobLimits {
  double least_area_px2 = 10.0;     ///< a circle of 3.6 px: what blur leaves of one of 6
  double most_area_px2 = 60'000.0;  ///< one of 276 px
  double least_fill = 0.9;          ///< a rectangle has 0.955, a half circle 0.89
  double least_slimness = 0.16;     ///< of the axes: a circle seen aslant at 80 degrees
};

/// Finds the connected spots of a picture line by line: each pixel belongs to a dark or to a bright
/// one, and a spot is judged when no line goes on with it. Nothing but two lines of runs and the
/// moments of the unfinished spots is kept. 0.7 MB: in a workspace.
class BlobScan {
 public:
  /// Appends to `blobs` what fits `limits` and lies wholly within the picture. A spot that is there
  /// already, from another threshold, is kept once, in the better form. False: the list ran full.
  [[nodiscard]] bool scan(const picture::AveragedPicture& picture, const ThresholdMap& thresholds,
                          const BlobLimits& limits, BlobList& blobs);

 private:
  struct Run {
    std::int32_t begin = 0;  ///< first pixel
    std::int32_t end = 0;    ///< behind the last
    std::int32_t part = 0;
    bool dark = false;
  };
  struct Part {
    std::int64_t area = 0;
    std::int64_t u = 0;
    std::int64_t v = 0;
    std::int64_t uu = 0;
    std::int64_t uv = 0;
    std::int64_t vv = 0;
    std::int32_t left = 0;
    std::int32_t right = 0;
    std::int32_t top = 0;
    std::int32_t bottom = 0;
    std::int32_t parent = 0;  ///< the part it was joined to, or itself
    bool dark = false;
  };
  using RunList = StaticVector<Run, kMaxSide_px>;
  // The runs of two lines, each with a part of its own at most.
  static constexpr std::int32_t kMaxParts = 2 * kMaxSide_px;

  void collect_runs(const picture::AveragedPicture& picture, const ThresholdMap& thresholds,
                    std::int32_t v);
  void join_lines(std::int32_t v);
  void finish_parts(std::int32_t v, const picture::AveragedPicture& picture,
                    const BlobLimits& limits, BlobList& blobs);
  std::int32_t take_part(const Run& run, std::int32_t v);
  [[nodiscard]] Part& part(std::int32_t index) { return parts_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] std::int32_t root_of_part(std::int32_t index);
  void add_run(Part& part, const Run& run, std::int32_t v);
  void judge(const Part& part, const picture::AveragedPicture& picture, const BlobLimits& limits,
             BlobList& blobs);

  std::array<std::uint16_t, kMaxSide_px> line_{};
  std::array<RunList, 2> runs_;
  std::int32_t now_ = 0;
  std::array<Part, kMaxParts> parts_{};
  StaticVector<std::int32_t, kMaxParts> active_;
  StaticVector<std::int32_t, kMaxParts> free_;
  bool overflown_ = false;
};

}  // namespace tubesight::core::detection
