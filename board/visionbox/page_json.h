#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "board/box/overlay_snapshot.h"
#include "core/base/reply.h"
#include "core/base/settings.h"

namespace tubesight::board {

// What the page is told, as docs/page.md says it.

using Json = nlohmann::ordered_json;

/// As text; bytes that are no UTF-8 are replaced.
[[nodiscard]] inline std::string text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// How the box is doing beside its picture, for the page's header.
struct PageSurroundings {
  double now_s = 0.0;  ///< of the clock that stamps fields
  bool lamp_dimmed = false;
  std::int32_t lamp_permille = 0;
  bool lamp_automatic = false;
  std::string lamp_words;
  std::string link_state;
  std::string link_words;
  std::string camera_words;
  double fields_per_s = 0.0;
};

/// A field's sighting with everything that is drawn into its picture.
[[nodiscard]] Json sighting_json(const OverlaySnapshot& marks, const core::SessionSettings& told,
                                 const PageSurroundings& around);

/// What the box said to the robot's claim.
[[nodiscard]] Json claim_json(const core::ClaimReply& claim);
/// The same in a sentence.
[[nodiscard]] std::string claim_words(const core::ClaimReply& claim);

[[nodiscard]] Json start_json(const core::StartReply& reply);
[[nodiscard]] Json pick_json(const core::PickReply& reply, bool plugged);
[[nodiscard]] Json sheet_json(const core::TubesheetSettings& sheet);

}  // namespace tubesight::board
