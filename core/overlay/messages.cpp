#include "core/overlay/messages.h"

#include "core/base/words.h"
#include "core/overlay/labels.h"
#include "core/overlay/palette.h"

namespace tubesight::core::overlay {

Messages::Messages(const OverlayInput& input) {
  const News& news = input.news;
  const bool contradicted = news.claim && news.claim->verdict == ClaimVerdict::kContradicted;
  // The refusal itself tells more than the state's reason that there was one.
  const bool refusal_is_reason = input.sighting.reason == Reason::kStartRefused &&
                                 news.refusal != StartRefusal::kNone && !contradicted;
  if (!refusal_is_reason) {
    add_reason(input);
  }
  if (contradicted) {
    add_claim(*news.claim);
  } else if (news.refusal != StartRefusal::kNone) {
    add_refusal(news.refusal);
  } else if (news.claim) {
    add_claim(*news.claim);
  }
}

Message& Messages::add() {
  ++count_;
  return messages_[static_cast<std::size_t>(count_ - 1)];
}

void Messages::add_reason(const OverlayInput& input) {
  const Sighting& sighting = input.sighting;
  const Words words = words_of(sighting.reason);
  if (!words.meaning.empty()) {
    Message& message = add();
    message.colour = colour_of(sighting.state);
    message.in_short.words(words.mark);
    message.words.words(words.meaning);
    const std::string_view advice = advice_on(sighting.reason);
    if (!advice.empty()) {
      message.words.words(": ").words(advice);
    }
    if (sighting.state == TrackState::kLost) {
      message.words.words(advice.empty() ? ": start anew" : ", then start anew");
    }
  } else if (sighting.axis_known && !sighting.tool_known) {
    Message& message = add();
    message.colour = palette::kStateDegraded;
    message.words.words("no tube is known above the guidetube");
    message.in_short.words("no tube known");
  }
}

void Messages::add_claim(const ClaimReply& claim) {
  Message& message = add();
  const TextLine claimed = address_text(claim.claimed);
  switch (claim.verdict) {
    case ClaimVerdict::kConfirmed:
      message.headline = "CONFIRMED";
      message.colour = palette::kStateTracking;
      message.words.words("robot claims ").words(claimed.view());
      break;
    case ClaimVerdict::kContradicted:
      message.headline = "CONTRADICTED";
      message.colour = palette::kStateLost;
      message.words.words("robot claims ").words(claimed.view());
      message.words.words(", box sees ").words(address_text(claim.tube).view());
      message.in_short.words("claimed ").words(claimed.view());
      message.in_short.words(", seen ").words(address_text(claim.tube).view());
      break;
    case ClaimVerdict::kUnknown:
      message.headline = "UNKNOWN";
      message.colour = palette::kCaption;
      message.words.words("claim ").words(claimed.view()).words(": ").words(explain(claim.doubt));
      break;
  }
}

void Messages::add_refusal(StartRefusal refusal) {
  Message& message = add();
  message.headline = "START REFUSED";
  message.colour = palette::kStateDegraded;
  message.words.words(explain(refusal));
}

std::string_view advice_on(Reason reason) {
  switch (reason) {
    case Reason::kNoStart: return "click into three tube-ends";
    case Reason::kStartRefused: return "click again";
    case Reason::kFewTubes: return "move the window or the light";
    case Reason::kDark: return "check lamp, cable and iris";
    case Reason::kWashedOut: return "less light or a shorter shutter";
    case Reason::kNoTubes: return "look what stands before the camera";
    case Reason::kDamagedField: return "check the camera and its cable";
    case Reason::kUncertain: return "widen the window";
    case Reason::kSpeed: return "check [motion]";
    case Reason::kGap: return "check the camera and its cable";
    case Reason::kTime: return "check the camera's driver";
    case Reason::kRate: return "a faster camera";
    case Reason::kFieldOrder: return "check scan of [camera]";
    case Reason::kArithmetic: return "please report this";
    case Reason::kNoField: return "check the camera and its cable";
    case Reason::kMap: return "check addresses and lists of plugs";
    case Reason::kNotLive: return "check lamp and camera";
    case Reason::kNone:
    case Reason::kCoasted:
    case Reason::kJump:
    case Reason::kSequence: break;
  }
  return {};
}

Rgb colour_of(TrackState state) {
  switch (state) {
    case TrackState::kTracking: return palette::kStateTracking;
    case TrackState::kDegraded: return palette::kStateDegraded;
    case TrackState::kLost: return palette::kStateLost;
    case TrackState::kWaiting: break;
  }
  return palette::kStateWaiting;
}

}  // namespace tubesight::core::overlay
