#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/base/sighting.h"
#include "core/overlay/overlay.h"
#include "core/overlay/pixels.h"
#include "core/overlay/text_line.h"

namespace tubesight::core::overlay {

/// One thing that the operator is to read.
struct Message {
  std::string_view headline;  ///< one word, written in a box of colour; may be empty
  TextLine words;
  TextLine in_short;  ///< where the words do not fit; may be empty
  Rgb colour;
};

/// What the operator is to read beneath the numbers: at most two messages.
class Messages {
 public:
  /// First why the state is not tracking and what to do about it, or that no tube is known above
  /// the guidetube; then the last claim when it is contradicted, else a start that was refused,
  /// else the claim.
  explicit Messages(const OverlayInput& input);

  [[nodiscard]] std::span<const Message> all() const {
    return std::span(messages_).first(static_cast<std::size_t>(count_));
  }

 private:
  Message& add();
  void add_reason(const OverlayInput& input);
  void add_claim(const ClaimReply& claim);
  void add_refusal(StartRefusal refusal);

  std::array<Message, 2> messages_{};
  std::int32_t count_ = 0;
};

/// What to do about a reason, in a few words; docs/messages.md tells more. Empty: nothing but to
/// start anew where the track is lost.
[[nodiscard]] std::string_view advice_on(Reason reason);

/// The colour of a state in the readout.
[[nodiscard]] Rgb colour_of(TrackState state);

}  // namespace tubesight::core::overlay
