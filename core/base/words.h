#pragma once

#include <concepts>
#include <cstdint>
#include <string_view>

#include "core/base/pose_result.h"
#include "core/base/reply.h"
#include "core/base/sighting.h"

namespace tubesight::core {

/// What is said of one value of an enumeration, wherever it is said.
struct Words {
  std::string_view word;     ///< the one word in files; empty: nothing to say
  std::string_view meaning;  ///< the same in a few words for a person
  std::string_view mark{};   ///< for the overlay's readout, 14 letters at most; may be empty
};

// A function a kind, so that the compiler finds a value that was forgotten. docs/messages.md has a
// row for each with its meaning and what to do; a test compares them.

/// Why the state is not tracking.
[[nodiscard]] constexpr Words words_of(Reason reason) {
  switch (reason) {
    case Reason::kNone: break;
    case Reason::kNoStart: return {"no-start", "nobody has named tubes yet", "for start"};
    case Reason::kStartRefused: return {"start-refused", "the start was refused", "start refused"};
    case Reason::kFewTubes: return {"few-tubes", "only two tube-ends left", "few tube-ends"};
    case Reason::kDark: return {"dark", "the picture shows no light", "too dark"};
    case Reason::kWashedOut: return {"washed-out", "the picture is saturated", "too bright"};
    case Reason::kNoTubes: return {"no-tubes", "no tube-ends where they should be", "no tube-ends"};
    case Reason::kDamagedField:
      return {"damaged-field", "a field was delivered damaged", "damaged field"};
    case Reason::kUncertain:
      return {"uncertain", "the picture tells the tool's place to over 0.75 mm only", "uncertain"};
    case Reason::kCoasted: return {"coasted", "nothing usable seen for too long", "blind too long"};
    case Reason::kJump:
      return {"jump", "the picture contradicts any motion within the limits", "picture jumped"};
    case Reason::kSpeed: return {"speed", "faster than [motion] allows", "too fast"};
    case Reason::kGap: return {"gap", "too many fields are missing", "fields missing"};
    case Reason::kTime:
      return {"time", "the time of a field is not after that of the field before", "time ran back"};
    case Reason::kSequence:
      return {"sequence", "the counter of the fields went back", "count ran back"};
    case Reason::kRate:
      return {"rate", "fields come too seldom for [motion] and the pitch", "rate too low"};
    case Reason::kFieldOrder:
      return {"field-order", "the order of the fields is not as the settings say", "field order"};
    case Reason::kArithmetic:
      return {"arithmetic", "a number left the range of the arithmetic", "out of range"};
    case Reason::kNoField: return {"no-field", "no field came in time", "no field came"};
    case Reason::kMap:
      return {"map", "sites that should be closed are open tube-ends", "map refuted"};
    case Reason::kNotLive: return {"not-live", "the picture does not follow the lamp", "not live"};
  }
  return {};
}

/// Why a start was refused.
[[nodiscard]] constexpr Words words_of(StartRefusal refusal) {
  switch (refusal) {
    case StartRefusal::kNone: break;
    case StartRefusal::kTooFew: return {"too-few", "fewer than three clicks"};
    case StartRefusal::kNoTubeThere:
      return {"no-tube-there", "no dark tube-end around a click: plate, or no light of the lamp"};
    case StartRefusal::kSameTubeTwice: return {"same-tube-twice", "two clicks in one tube-end"};
    case StartRefusal::kAddresses:
      return {"addresses", "addresses, lattice and camera contradict each other"};
    case StartRefusal::kHeight:
      return {"height", "the tube-ends' distances do not fit a tool below this sheet"};
    case StartRefusal::kSize:
      return {"size", "the tube-ends' sizes do not fit bore_mm, or LEDs alone light them"};
    case StartRefusal::kPicture:
      return {"picture", "other tube-ends are not where the clicks put them"};
    case StartRefusal::kMoved:
      return {"moved", "the tool may have moved since the picture clicked into"};
    case StartRefusal::kUnknownField:
      return {"unknown-field", "the picture clicked into is none that the box has seen"};
    case StartRefusal::kSuperseded:
      return {"superseded", "another start came before the same field"};
    case StartRefusal::kMap: return {"map", "sites that should be closed are open tube-ends"};
    case StartRefusal::kElsewhere:
      return {"elsewhere", "the tool was just seen too far from there to have come, confirm it"};
    case StartRefusal::kNotLive: return {"not-live", "the picture does not follow the lamp"};
  }
  return {};
}

/// Why a claim was answered "unknown".
[[nodiscard]] constexpr Words words_of(ClaimDoubt doubt) {
  switch (doubt) {
    case ClaimDoubt::kNone: break;
    case ClaimDoubt::kNoPicture: return {"no-picture", "no picture of that instant can be used"};
    case ClaimDoubt::kTooOld:
      return {"too-old", "the claim's instant is longer ago than claim_oldest_s"};
    case ClaimDoubt::kNotYet: return {"not-yet", "the claim's instant is too far ahead"};
    case ClaimDoubt::kNoSighting:
      return {"no-sighting", "no field within claim_within_s of the claim's instant"};
    case ClaimDoubt::kNotKnown: return {"not-known", "the box did not know its place then"};
    case ClaimDoubt::kNotAligned:
      return {"not-aligned", "the guidetube was near enough under no tube"};
    case ClaimDoubt::kMoving:
      return {"moving", "the tool may have gone to another tube since the nearest field"};
    case ClaimDoubt::kBusy: return {"busy", "too many claims are waiting for their field"};
  }
  return {};
}

/// Why a pick named no tube.
[[nodiscard]] constexpr Words words_of(PickDoubt doubt) {
  switch (doubt) {
    case PickDoubt::kNone: break;
    case PickDoubt::kNotTracking:
      return {"not-tracking", "the box did not know in that field which tubes it saw"};
    case PickDoubt::kNoTube: return {"no-tube", "no tube stands there"};
    case PickDoubt::kUnknownField: return {"unknown-field", "that field is none of the last ones"};
  }
  return {};
}

/// Why a pose request was refused.
[[nodiscard]] constexpr Words words_of(PoseReason reason) {
  switch (reason) {
    case PoseReason::kNone: break;
    case PoseReason::kNotTracking:
      return {"not-tracking", "the box does not know which tubes it sees"};
    case PoseReason::kMoving: return {"moving", "the tool moves"};
    case PoseReason::kBusy: return {"busy", "the request before is not answered yet"};
    case PoseReason::kPicture: return {"picture", "the picture shows too few sound tube-ends"};
    case PoseReason::kWeak: return {"weak", "the tube-ends measured don't determine the pose"};
    case PoseReason::kEnded: return {"ended", "the pictures ended before there were enough"};
  }
  return {};
}

/// An enumeration that has words; its first value says nothing.
template <typename E>
concept HasWords = requires(E value) {
  { words_of(value) } -> std::same_as<Words>;
};

/// The one word of a value in files; empty for kNone.
template <HasWords E>
[[nodiscard]] constexpr std::string_view name_of(E value) {
  return words_of(value).word;
}

/// What it means, in a few words for a person; docs/messages.md tells more.
template <HasWords E>
[[nodiscard]] constexpr std::string_view explain(E value) {
  return words_of(value).meaning;
}

/// How many values it has, the first with nothing to say among them.
template <HasWords E>
[[nodiscard]] constexpr std::int32_t count_of() {
  std::int32_t count = 1;
  while (!words_of(static_cast<E>(count)).word.empty()) {
    ++count;
  }
  return count;
}

}  // namespace tubesight::core
