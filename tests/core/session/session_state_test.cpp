// A session restored from a state goes on as the one that was saved: every step of a drawn mission
// is a place to save at, with claims waiting, starts and pose requests pending, in doubt, coasting
// and lost.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/sighting_state.h"
#include "core/base/state_stream.h"
#include "tests/core/session/sheet_run.h"
#include "tests/support/scalars.h"

namespace tubesight::core::session {
namespace {

/// Everything of an output that anybody could see.
std::uint64_t digest_of(const Output& output) {
  StateDigest digest;
  digest(output.sighting);
  for (const TubeSighting& tube : output.tubes) {
    digest(tube.address, tube.center_px, tube.quality_permyriad, tube.plug);
  }
  for (const Reply& reply : output.replies) {
    const auto kind = static_cast<std::uint32_t>(reply.content.index());
    digest(reply.id, kind, reply.at);
    digest.choice(reply.origin, EventOrigin::kOperator);
    if (const auto* const claim = content_if<ClaimReply>(reply)) {
      digest(claim->claimed, claim->tube, claim->field);
      digest.choice(claim->verdict, ClaimVerdict::kUnknown);
      digest.choice(claim->doubt, ClaimDoubt::kBusy);
    } else if (const auto* const start = content_if<StartReply>(reply)) {
      digest.choice(start->refusal, kLastStartRefusal);
    } else if (const auto* const pick = content_if<PickReply>(reply)) {
      digest(pick->tube);
      digest.choice(pick->doubt, PickDoubt::kUnknownField);
    } else if (const auto* const pose = content_if<PoseRequestReply>(reply)) {
      digest.choice(pose->refusal, PoseReason::kEnded);
    }
  }
  digest(output.lamp_permille, output.order.wanted);
  if (output.order.wanted) {
    digest(output.order.id);
  }
  return digest.value();
}

/// A field of the mission, drawn once.
struct Taken {
  Input input;
  Frame frame;
};

/// Draws a mission and says what a session gets in each of its steps.
class Mission {
 public:
  Mission() {
    tests::make_synthetic_settings(*settings, 2);
    sheet_ = std::make_unique<SyntheticSheet>(*settings);
    sheet_->look.noise = 2.0;
    sheet_->look.rolled_plugs = {{21, 11}};
    wait_and_start();
    move_and_ask();
    coast_and_be_lost();
    start_again();
    see_pictures_again();
    jump();
    swap_fields();
    miss_fields();
  }

  std::unique_ptr<SessionSettings> settings = std::make_unique<SessionSettings>();
  std::vector<std::unique_ptr<Taken>> steps;

 private:
  void wait_and_start() {
    for (int i = 0; i < 4; ++i) {
      step(kOverTube);
    }
    say(clicks(), number_ - 2);  // into a picture gone by: the still picture judges it
    for (int i = 0; i < 5; ++i) {
      step(kOverTube);
    }
  }

  void move_and_ask() {
    say(PoseRequest{});
    step(kOverTube);
    say(PoseRequest{});  // busy
    for (int i = 0; i < 14; ++i) {
      const double t = i * kFieldSpan_s;
      const ToolPlace place = moved(kOverTube, 600.0 * t * t, -300.0 * t * t);
      if (i % 3 == 1) {
        say(Claim{{20, 10}}, {}, now_ + kFieldSpan / 2);  // waits for the next field
        say(Claim{{20, 11}}, {}, now_ - 3 * kFieldSpan);
      }
      if (i == 6) {
        say(Pick{{150.0, 100.0}, number_ - 5});
        say(LampCommand{640});
      }
      status_ = i == 9 ? FieldStatus::kMissing : i == 12 ? FieldStatus::kDamaged : status_;
      step(place);
    }
  }

  void coast_and_be_lost() {
    const ToolPlace last = moved(kOverTube, 28.0, -14.0);
    sheet_->look.gain = 0.0;
    for (int i = 0; i < 20; ++i) {
      step(last);
    }
    sheet_->look.gain = 1.0;
  }

  void start_again() {
    for (int i = 0; i < 4; ++i) {
      step(kOverTube);
    }
    Start wrong = clicks();
    std::swap(wrong.tubes[0].address, wrong.tubes[1].address);
    say(wrong);
    step(kOverTube);
    say(clicks(), number_ - 1);
    for (int i = 0; i < 6; ++i) {
      step(kOverTube);
    }
    step(moved(kOverTube, 9.0));  // contradicts the motion
    step(moved(kOverTube, 0.2));
    step(moved(kOverTube, 0.3));
  }

  // At rest before a camera with noise, which is learnt: then equal pictures are old ones.
  void see_pictures_again() {
    say(clicks());
    rest(4);
    again_ = true;
    rest(3);
    again_ = false;
    rest(3);
  }

  void jump() {
    for (int i = 0; i < 3; ++i) {
      step(moved(kOverTube, 9.0, 7.0));
    }
  }

  // Each frame's first field was taken after its second.
  void swap_fields() {
    say(clicks());
    rest(4);
    for (int i = 0; i < 20; ++i) {
      const bool first = number_ % 2 != 0;  // of the field to come
      const double t = (i + (first ? 1 : -1)) * kFieldSpan_s;
      step(moved(kOverTube, way_after(t, kPitch_mm, 100.0, 2000.0)));
    }
  }

  // Two by their numbers, while fields come slowly; then many by the time.
  void miss_fields() {
    say(clicks());
    rest(4);
    span_ = kFieldSpan * 13 / 10;
    rest(3);
    skipped_ += 2;
    rest(3);
    now_ += 10 * kFieldSpan;
    rest(1);
  }

  void rest(int fields) {
    for (int i = 0; i < fields; ++i) {
      step(kOverTube);
    }
  }

  [[nodiscard]] Start clicks() const {
    SessionSettings& clicked = *scratch_;
    clicked = *settings;
    tests::set_clicks(*sheet_, kOverTube, {{20, 10}, {21, 10}, {20, 11}}, {3.0, -2.0}, clicked);
    return {clicked.start.tubes, {}, false};
  }

  template <typename Content>
  void say(Content content, std::optional<std::int64_t> seen = {},
           std::optional<FieldTime> at = {}) {
    if constexpr (requires { content.seen_field = seen; }) {
      content.seen_field = seen ? seen : content.seen_field;
    }
    Event event = tests::event_of(content, EventOrigin::kOperator);
    event.id = ++id_;
    event.at = at;
    EXPECT_TRUE(events_.try_push_back(event));
  }

  void step(const ToolPlace& place) {
    auto taken = std::make_unique<Taken>();
    const Parity parity = number_ % 2 == 0 ? Parity::kOdd : Parity::kEven;
    if (again_) {
      taken->frame = steps[steps.size() - 2]->frame;
    } else {
      sheet_->draw(place, parity, static_cast<std::uint32_t>(number_), taken->frame);
    }
    Field& field = taken->input.field;
    field.number = ++number_;
    field.status = status_;
    field.parity = parity;
    field.sequence = status_ == FieldStatus::kMissing ? 0 : 300 + number_ + skipped_;
    field.mid_exposure = now_;
    field.lamp_permille = 700;
    if (status_ != FieldStatus::kMissing) {
      field.pixels = sheet_->view(taken->frame, parity);
    }
    taken->input.events = events_;
    taken->input.lamp_dimmed = true;
    steps.push_back(std::move(taken));
    events_.clear();
    status_ = FieldStatus::kGood;
    now_ += span_;
  }

  std::unique_ptr<SyntheticSheet> sheet_;
  std::unique_ptr<SessionSettings> scratch_ = std::make_unique<SessionSettings>();
  EventList events_;
  FieldStatus status_ = FieldStatus::kGood;
  bool again_ = false;  ///< fields show the last picture of their parity
  FieldTime now_{1'000'000'000};
  FieldTime span_ = kFieldSpan;
  std::int64_t skipped_ = 0;  ///< sequence numbers
  std::int64_t number_ = 39;
  std::int64_t id_ = 0;
};

const Mission& mission() {
  static const Mission drawn;
  return drawn;
}

template <typename S>
class SessionState : public ::testing::Test {
 protected:
  static std::unique_ptr<Session<S>> fresh() {
    auto session = std::make_unique<Session<S>>();
    EXPECT_TRUE(session->configure(*mission().settings));
    return session;
  }
  /// A session after the first `steps` steps.
  static std::unique_ptr<Session<S>> after(std::size_t steps) {
    auto session = fresh();
    const auto output = std::make_unique<Output>();
    for (std::size_t i = 0; i < steps; ++i) {
      session->step(mission().steps[i]->input, *output);
    }
    return session;
  }
  static std::vector<std::byte> saved(const Session<S>& session) {
    std::vector<std::byte> bytes(Session<S>::state_bytes());
    const auto size = session.save(bytes);
    EXPECT_TRUE(size.has_value());
    bytes.resize(size.value_or(0));
    return bytes;
  }
  /// With a check sum that is right for what it holds now.
  static std::vector<std::byte> checked(std::vector<std::byte> bytes) {
    const std::span<std::byte> all(bytes);
    StateDigest digest;
    digest.add(all.first(all.size() - 8));
    std::uint64_t value = digest.value();
    StateWriter writer(all.last(8));
    writer(value);
    return bytes;
  }
  static std::optional<Error> refusal(const std::vector<std::byte>& bytes) {
    const auto restored = fresh()->restore(bytes);
    return restored ? std::optional<Error>() : restored.error();
  }
};

TYPED_TEST_SUITE(SessionState, tests::Scalars);

TYPED_TEST(SessionState, GoesOnFromEveryStepToTheSameBytes) {
  const auto& steps = mission().steps;
  const auto output = std::make_unique<Output>();
  std::vector<std::uint64_t> outputs;
  std::vector<std::vector<std::byte>> states;
  std::vector<int> seen(4);
  std::vector<Reason> losses;
  const auto session = this->fresh();
  for (const auto& step : steps) {
    states.push_back(this->saved(*session));
    session->step(step->input, *output);
    outputs.push_back(digest_of(*output));
    const Sighting& sighting = output->sighting;
    ++seen[static_cast<std::size_t>(sighting.state)];
    if (sighting.state == TrackState::kLost &&
        (losses.empty() || losses.back() != sighting.reason)) {
      losses.push_back(sighting.reason);
    }
  }
  for (const int fields : seen) {
    EXPECT_GT(fields, 1) << "a mission through all states";
  }
  EXPECT_EQ(losses,
            (std::vector{Reason::kCoasted, Reason::kNoTubes, Reason::kFieldOrder, Reason::kGap}));

  for (std::size_t from = 0; from < steps.size(); ++from) {
    const auto restored = this->fresh();
    ASSERT_TRUE(restored->restore(states[from])) << "before step " << from;
    // Far enough for a track to be lost or to answer what waits; now and then to the end.
    const std::size_t end = from % 8 == 0 ? steps.size() : std::min(from + 6, steps.size());
    for (std::size_t i = from; i < end; ++i) {
      restored->step(steps[i]->input, *output);
      ASSERT_EQ(digest_of(*output), outputs[i]) << "step " << i << " from step " << from;
    }
    const auto again = this->fresh();
    ASSERT_TRUE(again->restore(states[from]));
    EXPECT_EQ(this->saved(*again), states[from]) << "before step " << from;
  }
}

TYPED_TEST(SessionState, FitsTheSpaceToldForIt) {
  const auto session = this->after(mission().steps.size());
  const std::vector<std::byte> whole = this->saved(*session);
  EXPECT_GT(whole.size(), 3'000U);
  std::vector<std::byte> bytes(whole.size());
  EXPECT_TRUE(session->save(bytes));
  bytes.pop_back();
  EXPECT_EQ(session->save(bytes).error(), Error::kBufferTooSmall);
  EXPECT_EQ(session->save({}).error(), Error::kBufferTooSmall);
}

TYPED_TEST(SessionState, IsRefusedWhenDamagedAnywhere) {
  const auto session = this->after(12);
  const std::vector<std::byte> whole = this->saved(*session);
  for (std::size_t i = 0; i < whole.size(); i += 61) {
    std::vector<std::byte> damaged = whole;
    damaged[i] ^= std::byte{4};
    ASSERT_EQ(this->refusal(damaged), Error::kDataLoss) << "byte " << i;
  }
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{47}, whole.size() - 1}) {
    EXPECT_EQ(this->refusal({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}),
              Error::kDataLoss);
  }
  std::vector<std::byte> longer = whole;
  longer.push_back(std::byte{0});
  EXPECT_EQ(this->refusal(longer), Error::kDataLoss);
}

TYPED_TEST(SessionState, IsRefusedWhenOfAnotherVersionOrSettings) {
  const auto session = this->after(12);
  std::vector<std::byte> other = this->saved(*session);
  other[8] ^= std::byte{1};  // the version
  EXPECT_EQ(this->refusal(this->checked(other)), Error::kUnsupported);

  const auto settings = std::make_unique<SessionSettings>(*mission().settings);
  settings->motion.max_speed_mm_s += 1.0;
  const auto elsewhere = std::make_unique<Session<TypeParam>>();
  ASSERT_TRUE(elsewhere->configure(*settings));
  EXPECT_EQ(elsewhere->restore(this->saved(*session)).error(), Error::kInvalidArgument);
}

TYPED_TEST(SessionState, IsRefusedWhenItHoldsWhatNoSessionComesTo) {
  std::vector<std::byte> forged = this->saved(*this->after(12));
  forged[40] = std::byte{200};  // the track's state, the first value of the body
  EXPECT_EQ(this->refusal(this->checked(forged)), Error::kOutOfRange);
}

TEST(SessionStateScalars, AreNotMixedUp) {
  const auto session = std::make_unique<Session<double>>();
  ASSERT_TRUE(session->configure(*mission().settings));
  std::vector<std::byte> bytes(Session<double>::state_bytes());
  const auto size = session->save(bytes);
  ASSERT_TRUE(size);
  const auto fixed = std::make_unique<Session<FixedPoint>>();
  ASSERT_TRUE(fixed->configure(*mission().settings));
  EXPECT_EQ(fixed->restore(std::span(bytes).first(*size)).error(), Error::kUnsupported);
}

}  // namespace
}  // namespace tubesight::core::session
