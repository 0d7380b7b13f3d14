#include "core/overlay/messages.h"

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/words.h"
#include "core/overlay/font.h"
#include "core/overlay/palette.h"

namespace tubesight::core::overlay {
namespace {

OverlayInput in_state(TrackState state, Reason reason) {
  OverlayInput input;
  input.sighting.state = state;
  input.sighting.reason = reason;
  return input;
}

// Headline and words, one text a message.
std::vector<std::string> told(const OverlayInput& input) {
  std::vector<std::string> texts;
  const Messages messages(input);
  for (const Message& message : messages.all()) {
    std::string text(message.headline);
    text += text.empty() ? "" : "|";
    text += message.words.view();
    texts.push_back(text);
  }
  return texts;
}

using Texts = std::vector<std::string>;

TEST(Messages, SayNothingWhileItTracks) {
  EXPECT_EQ(told(in_state(TrackState::kTracking, Reason::kNone)), Texts{});
}

TEST(Messages, TellTheReasonAndWhatToDo) {
  EXPECT_EQ(told(in_state(TrackState::kDegraded, Reason::kDark)),
            Texts{"the picture shows no light: check lamp, cable and iris"});
  EXPECT_EQ(told(in_state(TrackState::kLost, Reason::kGap)),
            Texts{"too many fields are missing: check the camera and its cable, then start anew"});
  EXPECT_EQ(told(in_state(TrackState::kLost, Reason::kCoasted)),
            Texts{"nothing usable seen for too long: start anew"});
  EXPECT_EQ(told(in_state(TrackState::kDegraded, Reason::kJump)),
            Texts{"the picture contradicts any motion within the limits"});
}

TEST(Messages, TellThatNoTubeIsKnownAboveTheGuidetube) {
  OverlayInput input = in_state(TrackState::kTracking, Reason::kNone);
  input.sighting.axis_known = true;

  EXPECT_EQ(told(input), Texts{"no tube is known above the guidetube"});

  input.sighting.tool_known = true;
  EXPECT_EQ(told(input), Texts{});
}

TEST(Messages, TellEachVerdictOnAClaim) {
  OverlayInput input = in_state(TrackState::kTracking, Reason::kNone);
  input.news.claim = ClaimReply{{40, 61}, ClaimVerdict::kConfirmed, ClaimDoubt::kNone, {40, 61}, 5};
  EXPECT_EQ(told(input), Texts{"CONFIRMED|robot claims 40,61"});

  input.news.claim->verdict = ClaimVerdict::kContradicted;
  input.news.claim->tube = {40, -62};
  EXPECT_EQ(told(input), Texts{"CONTRADICTED|robot claims 40,61, box sees 40,-62"});

  input.news.claim->verdict = ClaimVerdict::kUnknown;
  input.news.claim->doubt = ClaimDoubt::kBusy;
  EXPECT_EQ(told(input), Texts{"UNKNOWN|claim 40,61: too many claims are waiting for their field"});
}

TEST(Messages, ARefusedStartStandsInPlaceOfTheStatesReasonThatThereWasOne) {
  OverlayInput input = in_state(TrackState::kWaiting, Reason::kStartRefused);
  input.news.refusal = StartRefusal::kSameTubeTwice;

  EXPECT_EQ(told(input), Texts{"START REFUSED|two clicks in one tube-end"});

  input.sighting.state = TrackState::kLost;
  input.sighting.reason = Reason::kCoasted;
  EXPECT_EQ(told(input), (Texts{"nothing usable seen for too long: start anew",
                                "START REFUSED|two clicks in one tube-end"}));
}

TEST(Messages, AContradictionIsNeverHiddenByAnythingElse) {
  OverlayInput input = in_state(TrackState::kWaiting, Reason::kStartRefused);
  input.news.refusal = StartRefusal::kSameTubeTwice;
  input.news.claim =
      ClaimReply{{40, 61}, ClaimVerdict::kContradicted, ClaimDoubt::kNone, {40, 62}, 5};

  const auto texts = told(input);

  ASSERT_EQ(texts.size(), 2U);
  EXPECT_EQ(texts[1], "CONTRADICTED|robot claims 40,61, box sees 40,62");
}

// Whatever is said can be written: the font has each of its letters, and a line holds it.
TEST(Messages, OfEveryKindCanBeWritten) {
  const auto expect_written = [](const OverlayInput& input) {
    for (const std::string& text : told(input)) {
      for (const char character : text) {
        EXPECT_TRUE(character == '|' || has_glyph(character)) << text;
      }
    }
  };
  for (int code = 0; code < count_of<Reason>(); ++code) {
    expect_written(in_state(TrackState::kLost, static_cast<Reason>(code)));
  }
  for (int code = 0; code < count_of<StartRefusal>(); ++code) {
    OverlayInput input = in_state(TrackState::kTracking, Reason::kNone);
    input.news.refusal = static_cast<StartRefusal>(code);
    expect_written(input);
  }
  for (int code = 0; code < count_of<ClaimDoubt>(); ++code) {
    OverlayInput input = in_state(TrackState::kTracking, Reason::kNone);
    constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min();
    input.news.claim = ClaimReply{
        {kLow, kLow}, ClaimVerdict::kUnknown, static_cast<ClaimDoubt>(code), {kLow, kLow}, 5};
    expect_written(input);
  }
}

}  // namespace
}  // namespace tubesight::core::overlay
