#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/static_vector.h"
#include "core/detection/blob_scan.h"
#include "core/detection/element_edge.h"
#include "core/detection/ellipse.h"
#include "core/detection/lattice_growth.h"
#include "core/detection/lens_bend.h"
#include "core/detection/local_map.h"
#include "core/detection/portrait.h"
#include "core/detection/threshold_map.h"
#include "core/detection/verdict.h"
#include "core/picture/averaged_picture.h"

namespace tubesight::core::detection {

/// A dot or tube-end found.
struct LatticeElement {
  std::int32_t row = 0;
  std::int32_t column = 0;
  Ellipse ellipse;  ///< its outline; of the spot's pixels where the edge was not measured
  /// The image of its centre, by the lattice around it. The ellipse's own centre is not it.
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  /// The centroid of its area in the picture, for what is predicted as such.
  Eigen::Vector2d centroid_px = Eigen::Vector2d::Zero();
  double contrast = 0.0;     ///< with what is around, grey levels; -1: at the picture's edge
  double share = 0.0;        ///< of the outline that was measured; 0: none of it
  double rms_px = 0.0;       ///< of the edge's points from the ellipse
  bool by_contrast = false;  ///< no edge was measured, and its share is 0 in the end
  bool faint = false;        ///< so little of it is seen that its neighbours say where it is
  Levels levels;             ///< above the picture's darkest
};

/// A lattice found in a picture. 0.1 MB.
struct FoundLattice {
  bool dark = true;  ///< dark elements on bright, or the reverse
  Steps steps;       ///< in radii, in the lattice's own plane
  StaticVector<LatticeElement, kMaxElements> elements;
};

/// How a lattice is looked for.
struct FinderOptions {
  BlobLimits blobs;
  double least_contrast = 10.0;  ///< grey levels between an element and what surrounds it
  /// Tube-ends that show no edge are taken, too, by their light (look_at_faint()): to be shown and
  /// counted. Nothing is to be measured from where they are.
  bool with_faint = false;
};

/// Why there is none.
enum class FinderRefusal : std::uint8_t {
  kNone,
  kSize,      ///< a side beyond kMaxSide_px, or shorter than three tiles
  kFlat,      ///< no contrast anywhere
  kTooMany,   ///< more than kMaxBlobs spots: a texture, not a lattice
  kNoLattice  ///< no five like spots that make rows and columns
};

/// Finds a plane lattice of equal circles, dots of a template or tube-ends, in one picture without
/// being told anything: neither where it is nor how it is built, seen or lit.
///
/// Spots that are ellipses, at two thresholds (BlobScan); their order (LatticeGrowth); the edge of
/// each (measure_element); what does not stand where its neighbours say is left out, and what they
/// let expect is looked for where it was not found, hidden in part or cut off by the picture.
/// Some 5 MB: in a workspace, never on a stack.
class LatticeFinder {
 public:
  /// Looks for the larger of the dark and the bright lattice. `scratch` holds as many pixels as the
  /// picture.
  [[nodiscard]] FinderRefusal find(const picture::AveragedPicture& picture,
                                   const FinderOptions& options, std::span<std::uint16_t> scratch,
                                   FoundLattice& found);

 private:
  // Rows and columns count from 0 after the growth; completion goes on to both sides.
  static constexpr std::int32_t kMargin = 8;
  static constexpr std::int32_t kSide = 2 * kMaxIndex + 1 + 2 * kMargin;

  [[nodiscard]] FinderRefusal find_blobs(const picture::AveragedPicture& picture,
                                         const FinderOptions& options,
                                         std::span<const double> shares);
  [[nodiscard]] static bool has_few_edges(const FoundLattice& found);
  [[nodiscard]] bool look_darker(const picture::AveragedPicture& stretched,
                                 const FinderOptions& options, FoundLattice& found);
  [[nodiscard]] double area_of(const Growth& growth) const;
  void take_places(const Growth& growth, FoundLattice& found);
  void measure_all(const picture::AveragedPicture& stretched, FoundLattice& found);
  void straighten(const picture::AveragedPicture& stretched, const FoundLattice& found);
  void measure_steps(FoundLattice& found);
  void drop_strangers(FoundLattice& found);
  void measure_doubtful(const picture::AveragedPicture& stretched, FoundLattice& found);
  void drop_unsure(FoundLattice& found);
  [[nodiscard]] float how_strange(const FoundLattice& found, const LatticeElement& element) const;
  [[nodiscard]] bool is_worst(const FoundLattice& found,
                              const std::array<float, kMaxElements>& strange,
                              std::int32_t index) const;
  [[nodiscard]] double black_around(const FoundLattice& found, std::int32_t row,
                                    std::int32_t column) const;
  [[nodiscard]] bool is_faint(const FoundLattice& found, const LatticeElement& element) const;
  void complete(const picture::AveragedPicture& stretched, FoundLattice& found);
  void look_beside(const picture::AveragedPicture& stretched, std::int32_t from, std::int32_t steps,
                   FoundLattice& found);
  [[nodiscard]] bool look_for_blob(const picture::AveragedPicture& stretched, const LocalMap& map,
                                   const FoundLattice& found, LatticeElement& element);
  bool try_place(const picture::AveragedPicture& stretched, std::int32_t from, std::int32_t row,
                 std::int32_t column, FoundLattice& found);
  void drop_closed(const picture::AveragedPicture& stretched, FoundLattice& found);
  void add_faint(const picture::AveragedPicture& stretched, FoundLattice& found);
  void add_faint_around(const picture::AveragedPicture& stretched, std::int32_t from,
                        std::int32_t reach, FoundLattice& found);
  [[nodiscard]] bool look_for_faint(const picture::AveragedPicture& stretched,
                                    const FoundLattice& found, LatticeElement& element);
  [[nodiscard]] bool look_beside_place(const picture::AveragedPicture& stretched,
                                       const LocalMap& map, const FoundLattice& found,
                                       LatticeElement& element);
  void settle(const picture::AveragedPicture& stretched, FoundLattice& found);
  [[nodiscard]] Verdict look_at(const picture::AveragedPicture& stretched, const LocalMap& map,
                                const FoundLattice& found, LatticeElement& element,
                                Resemblance& whole);
  [[nodiscard]] bool fit_weighed(const FoundLattice& found, std::int32_t row, std::int32_t column,
                                 LocalMap& map) const;
  void find_centers(FoundLattice& found);
  static void weigh_all(const picture::AveragedPicture& stretched, FoundLattice& found);
  static void count_from_zero(FoundLattice& found);
  [[nodiscard]] MapPoints around(const FoundLattice& found, std::int32_t row, std::int32_t column,
                                 bool with_itself) const;
  [[nodiscard]] bool in_table(std::int32_t row, std::int32_t column) const;
  [[nodiscard]] std::int16_t& entry(std::int32_t row, std::int32_t column);
  [[nodiscard]] std::int16_t entry(std::int32_t row, std::int32_t column) const;
  void fill_table(const FoundLattice& found);

  ThresholdMap thresholds_;
  BlobScan scan_;
  BlobList blobs_;
  LatticeGrowth growth_;
  std::array<Growth, 2> grown_;  ///< dark, bright
  FoundLattice darker_;
  ElementScratch element_;
  PortraitGallery gallery_;
  LensBend lens_;
  std::array<IndexedPoint, kMaxElements> indexed_{};
  std::array<std::array<double, kMaxElements>, 3> forms_{};
  double least_contrast_ = 0.0;  ///< of the options of this search
  std::array<std::int16_t, static_cast<std::size_t>(kSide) * kSide> table_{};
};

}  // namespace tubesight::core::detection
