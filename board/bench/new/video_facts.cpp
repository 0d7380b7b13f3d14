#include "board/bench/new/video_facts.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "board/bench/input/recording_input.h"
#include "board/bench/output/still_reader.h"
#include "core/detection/lattice_finder.h"
#include "core/picture/averaged_picture.h"
#include "drivers/files/decimal.h"
#include "drivers/files/y4m_reader.h"
#include "drivers/settings/session_keys.h"

namespace tubesight::board {
namespace {

using core::Result;
using core::Unexpected;
using core::detection::FoundLattice;
using core::detection::LatticeElement;

const LatticeElement* element_at(const FoundLattice& found, std::int32_t row, std::int32_t column) {
  const auto at = std::find_if(found.elements.begin(), found.elements.end(),
                               [&](const LatticeElement& element) {
                                 return element.row == row && element.column == column;
                               });
  return at == found.elements.end() ? nullptr : at;
}

/// Whether a click in its middle is in its dark: enough of its outline was measured, and it stands
/// midway between its neighbours to both sides, as none does that something hides in part.
bool is_clear(const FoundLattice& found, const LatticeElement* element) {
  constexpr double kLeastShare = 0.7;
  constexpr double kOff =
      0.2;  // of the way between the neighbours; a camera 48 degrees aslant: 0.12
  if (element == nullptr || element->share < kLeastShare) {
    return false;
  }
  for (const auto& [row, column] : {std::pair{1, 0}, std::pair{0, 1}}) {
    const LatticeElement* const next =
        element_at(found, element->row + row, element->column + column);
    const LatticeElement* const last =
        element_at(found, element->row - row, element->column - column);
    if (next == nullptr || last == nullptr ||
        (next->center_px + last->center_px - 2.0 * element->center_px).norm() >
            kOff * (next->center_px - last->center_px).norm()) {
      return false;
    }
  }
  return true;
}

std::optional<LatticeFacts> facts_of(const FoundLattice& found, const Eigen::Vector2d& middle_px) {
  const LatticeElement* middle = nullptr;
  for (const LatticeElement& element : found.elements) {
    const bool nearer = middle == nullptr || (element.center_px - middle_px).norm() <
                                                 (middle->center_px - middle_px).norm();
    if (nearer && is_clear(found, &element) &&
        is_clear(found, element_at(found, element.row + 1, element.column)) &&
        is_clear(found, element_at(found, element.row, element.column + 1))) {
      middle = &element;
    }
  }
  if (middle == nullptr) {
    return {};
  }
  LatticeFacts facts;
  facts.elements = static_cast<std::int32_t>(found.elements.size());
  facts.middle_px = middle->center_px;
  facts.next_row_px = element_at(found, middle->row + 1, middle->column)->center_px;
  facts.next_column_px = element_at(found, middle->row, middle->column + 1)->center_px;
  facts.diameter_px = 2.0 * half_axes(middle->ellipse)[0];
  const auto& [column, row] = found.steps;  // in radii
  facts.angle_deg =
      std::acos(std::clamp(row.dot(column) / (row.norm() * column.norm()), -1.0, 1.0)) * 180.0 /
      std::numbers::pi;
  facts.diameter_share = 2.0 / std::min(row.norm(), column.norm());
  for (const LatticeElement& element : found.elements) {
    if (is_clear(found, &element)) {
      facts.places.push_back(
          {{element.row - middle->row, element.column - middle->column}, element.center_px});
    }
  }
  return facts;
}

std::optional<LatticeFacts> find_lattice(const drivers::GreyPicture& picture) {
  std::vector<std::uint16_t> sums(picture.pixels.size());
  std::vector<std::uint16_t> scratch(picture.pixels.size());
  const auto averaged = core::picture::average_of_one(picture.view(), sums);
  if (!averaged) {
    return {};
  }
  const auto finder = std::make_unique<core::detection::LatticeFinder>();
  const auto found = std::make_unique<FoundLattice>();
  if (finder->find(*averaged, {}, scratch, *found) != core::detection::FinderRefusal::kNone ||
      !found->dark) {  // tube-ends are dark
    return {};
  }
  return facts_of(*found, {(picture.width_px - 1) / 2.0, (picture.height_px - 1) / 2.0});
}

/// What a recording's header says of rate and order of the lines.
void take_header(const drivers::Y4mHeader& header, VideoFacts& facts) {
  if (header.rate_numerator > 0) {
    facts.rate_hz =
        static_cast<double>(header.rate_numerator) / static_cast<double>(header.rate_denominator);
  }
  switch (header.interlacing) {
    case drivers::Y4mInterlacing::kEvenFirst: facts.scan = core::Scan::kEvenFirst; break;
    case drivers::Y4mInterlacing::kOddFirst: facts.scan = core::Scan::kOddFirst; break;
    case drivers::Y4mInterlacing::kProgressive: facts.scan = core::Scan::kProgressive; break;
    case drivers::Y4mInterlacing::kUnstated: break;
  }
}

}  // namespace

Result<void> read_video_facts(const std::string& file, VideoFacts& facts, std::string& message) {
  facts = {};
  const std::vector<Still> stills = stills_of(std::vector{file}, {});
  StillReader reader;
  drivers::GreyPicture picture;
  TUBESIGHT_TRY(reader.read(stills.front(), picture, message));
  take_header(reader.header(), facts);
  facts.width_px = picture.width_px;
  facts.height_px = picture.height_px;
  facts.lattice = find_lattice(picture);
  return {};
}

std::string facts_text(const std::string& file, const VideoFacts& facts) {
  std::string text;
  drivers::print(text, "%s: %d x %d px", file.c_str(), facts.width_px, facts.height_px);
  if (facts.rate_hz > 0.0) {
    drivers::print(text, ", %.5g frames a second", facts.rate_hz);
  }
  if (facts.scan) {
    text += ", " + std::string(drivers::kScanWords[static_cast<std::size_t>(*facts.scan)]);
  }
  if (facts.lattice) {
    drivers::print(text,
                   "; %d tube-ends in the first frame, of %.0f px, rows and columns %.0f degrees "
                   "apart\n",
                   facts.lattice->elements, facts.lattice->diameter_px, facts.lattice->angle_deg);
  } else {
    text += "; no tube-ends found in the first frame\n";
  }
  return text;
}

}  // namespace tubesight::board
