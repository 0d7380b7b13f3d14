#include "board/bench/pose/pose_words.h"

#include <array>
#include <cstdio>

#include "drivers/settings/session_checks.h"

namespace tubesight::board {
namespace {

using core::picture::RimFinding;
using core::picture::ScanRefusal;
using core::pose::PictureRefusal;
using core::pose::PoseRefusal;

std::string_view explain(ScanRefusal refusal) {
  switch (refusal) {
    case ScanRefusal::kNone: return "";
    case ScanRefusal::kOutside: return "is at the picture's border or outside it";
    case ScanRefusal::kNotDark: return "is on the sheet, not inside a tube-end";
    case ScanRefusal::kNoBoundary: return "has no tube-end's edges around it";
    case ScanRefusal::kFewEdges: return "has too few edges around it that continue each other";
  }
  return "";
}

std::string in_pixels(double px) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f px", px);
  return text.data();
}

}  // namespace

std::string_view explain(PoseRefusal refusal) {
  switch (refusal) {
    case PoseRefusal::kNone: return "";
    case PoseRefusal::kTooFewTubes: return "fewer usable tube-ends than the pose needs";
    case PoseRefusal::kCollinear:
      return "the tube-ends lie in one line, which leaves the tilt open";
    case PoseRefusal::kAmbiguous: return "two poses fit the picture";
    case PoseRefusal::kResidualTooLarge: return "the rims are not where any pose puts them";
    case PoseRefusal::kAddressesContradict: return "the addresses contradict the picture";
    case PoseRefusal::kIllConditioned: return "the tube-ends don't determine the pose";
  }
  return "";
}

std::string_view explain(RimFinding finding) {
  switch (finding) {
    case RimFinding::kMeasured: return "measured";
    case RimFinding::kPartly: return "partly measured";
    case RimFinding::kOutside: return "mostly outside the picture";
    case RimFinding::kTooSmall: return "too small in the picture";
    case RimFinding::kBright: return "no dark inside: a plug, or hidden";
    case RimFinding::kNoEdge: return "no edge where it should be: hidden, a plug, or too dark";
    case RimFinding::kOutOfShape: return "edges that are no circle's";
  }
  return "";
}

std::string explain(const core::pose::PictureOutcome& outcome,
                    std::span<const core::pose::PictureStart> starts) {
  std::string tube;
  std::string place;
  if (outcome.start >= 0) {
    const auto& start = starts[static_cast<std::size_t>(outcome.start)];
    tube = drivers::address_text(start.address);
    place = " at " + drivers::point_text({start.u_px, start.v_px});
  }
  switch (outcome.refusal) {
    case PictureRefusal::kNone: return {};
    case PictureRefusal::kTooFewStarts:
      return "no pose: " + std::to_string(starts.size()) +
             " tube-ends are named, expected at least 3";
    case PictureRefusal::kStart:
      return "no pose: the place of " + tube + place + ' ' + std::string(explain(outcome.scan)) +
             ", expected a place in its dark";
    case PictureRefusal::kSameTube:
      return "no pose: the place of " + tube + place +
             " is in the tube-end that another place names, expected one place a tube-end";
    case PictureRefusal::kNoSuchTube:
      return "no pose: " + tube + " is no open tube-end of this tubesheet";
    case PictureRefusal::kPose: break;
  }
  std::string text = "no pose: " + std::string(explain(outcome.pose.refusal));
  if (outcome.pose.refusal == PoseRefusal::kResidualTooLarge) {
    text += " (they are off by " + in_pixels(outcome.pose.estimate.rms_px) + " RMS)";
  }
  return text;
}

}  // namespace tubesight::board
