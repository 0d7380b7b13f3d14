#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include "core/base/static_vector.h"
#include "core/detection/blob_scan.h"

namespace tubesight::core::detection {

/// Elements of one lattice: a template of 32 x 32 dots.
inline constexpr std::int32_t kMaxElements = 1024;

/// Rows and columns stay within this of the element that the lattice grew from.
inline constexpr std::int32_t kMaxIndex = 64;

/// Where an element stands on the lattice found, and which spot it is.
struct Place {
  std::int32_t row = 0;
  std::int32_t column = 0;
  std::int32_t blob = 0;  ///< in the list that the lattice grew in
};

/// The lattice's steps in its own plane, in radii of its elements: all that a picture without a
/// camera tells, up to a turn.
struct Steps {
  Eigen::Vector2d column = Eigen::Vector2d::Zero();
  Eigen::Vector2d row = Eigen::Vector2d::Zero();
};

/// What grew.
struct Growth {
  StaticVector<Place, kMaxElements> places;
  Steps steps;
};

/// Orders equal circles of a plane lattice that a picture shows as ellipses.
///
/// An ellipse tells, up to a turn, how the picture shows the plane around it: what turns it into a
/// circle makes the plane look as if seen straight on. Seen so, neighbours stand the same number of
/// radii off and in the same directions all over the picture, however it is taken. A join of two
/// centres is straight in both, so the turn is carried from one element to the next along it, and
/// the length of a step is measured against the mean of the ellipses at its ends, which is right to
/// the second order of perspective and far within what tells one neighbour from the next. 0.5 MB:
/// in a workspace.
class LatticeGrowth {
 public:
  /// Orders the spots of one kind, dark or bright: the largest lattice among them. Its columns run
  /// rightwards in the picture as nearly as they can, and rows so that a turn from columns to rows
  /// is one from u to v. Empty when no five spots make one with two rows and two columns.
  void grow(const BlobList& blobs, bool dark, Growth& growth);

 private:
  /// A neighbour, in the plane as seen straight on from an element, in radii.
  struct Link {
    std::int32_t other = -1;
    Eigen::Vector2d offset = Eigen::Vector2d::Zero();
    double distance = 0.0;
  };
  static constexpr std::int32_t kLinks = 10;
  struct Node {
    StaticVector<Link, kLinks> links;
    Eigen::Vector2d turn = Eigen::Vector2d::Zero();  ///< cosine and sine, from the lattice's plane
    std::int32_t row = 0;
    std::int32_t column = 0;
    bool other_kind = false;  ///< bright where dark ones are ordered, or the reverse
    bool placed = false;      ///< in the largest lattice so far
    bool here = false;        ///< in the one that grows
  };
  static constexpr std::int32_t kSide = 2 * kMaxIndex + 1;

  std::int32_t link_all(const BlobList& blobs, bool dark);
  void link(const BlobList& blobs, std::int32_t from, std::int32_t to);
  [[nodiscard]] static bool choose_steps(const Node& seed, bool symmetric, Steps& steps);
  void grow_from(std::int32_t seed, const Steps& steps, Growth& growth);
  void look_around(std::int32_t from, const Steps& steps, Growth& growth);
  void average_steps(Growth& growth) const;
  [[nodiscard]] bool leaves_out_some(const BlobList& blobs, const Growth& growth) const;
  static void lay_out(const BlobList& blobs, Growth& growth);
  [[nodiscard]] Node& node(std::int32_t i) { return nodes_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Node& node(std::int32_t i) const {
    return nodes_[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] std::int16_t& taken(std::int32_t row, std::int32_t column) {
    return taken_[static_cast<std::size_t>((row + kMaxIndex) * kSide + column + kMaxIndex)];
  }

  std::array<Node, kMaxBlobs> nodes_{};
  std::int32_t count_ = 0;
  std::array<std::int16_t, static_cast<std::size_t>(kSide) * kSide> taken_{};
  Growth trial_;
};

}  // namespace tubesight::core::detection
