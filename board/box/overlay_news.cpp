#include "board/box/overlay_news.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

namespace tubesight::board {
namespace {

constexpr core::FieldTime kShown = std::chrono::seconds(3);

// A tool that moves faster takes the tube-ends away from where they were clicked.
constexpr std::int32_t kMoving_um_s = 10'000;

bool moves(const core::Sighting& sighting) {
  return sighting.velocity_known && (std::abs(sighting.velocity_um_s[0]) > kMoving_um_s ||
                                     std::abs(sighting.velocity_um_s[1]) > kMoving_um_s);
}

// Clicks come from outside: what lies beyond any picture stays there.
std::int32_t q16(double px) {
  constexpr double kFarthest_px = 32'000.0;
  const double held = std::isfinite(px) ? std::clamp(px, -kFarthest_px, kFarthest_px) : 0.0;
  return static_cast<std::int32_t>(std::lround(held * 65536.0));
}

core::overlay::ClickVerdict verdict_of(const core::StartReply& reply, std::int32_t click) {
  if (reply.refusal == core::StartRefusal::kNone) {
    return core::overlay::ClickVerdict::kTaken;
  }
  return reply.click == click ? core::overlay::ClickVerdict::kBlamed
                              : core::overlay::ClickVerdict::kRefused;
}

}  // namespace

void OverlayNews::take(const core::session::Input& input, const core::session::Output& output) {
  for (const core::Event& event : input.events) {
    const auto* const start = core::content_if<core::Start>(event);
    if (start != nullptr) {
      // Starts are answered in the step that they came with.
      for (const core::Reply& reply : output.replies) {
        const auto* const answer = core::content_if<core::StartReply>(reply);
        if (answer != nullptr && reply.id == event.id && reply.origin == event.origin) {
          take_start(*start, *answer);
          start_at_ = output.sighting.time;
        }
      }
    }
    if (core::content_if<core::Acknowledge>(event) != nullptr) {
      claim_.reset();
    }
  }
  for (const core::Reply& reply : output.replies) {
    if (const auto* const claim = core::content_if<core::ClaimReply>(reply)) {
      claim_ = *claim;
      claim_at_ = output.sighting.time;
    }
  }
  forget_old(output.sighting);
}

void OverlayNews::take_start(const core::Start& start, const core::StartReply& reply) {
  refusal_ = reply.refusal;
  clicks_.clear();
  for (std::int32_t i = 0; i < start.tubes.size(); ++i) {
    const core::StartPoint& point = start.tubes[i];
    // The lists are of one capacity.
    static_cast<void>(clicks_.try_push_back(
        {{q16(point.at_px[0]), q16(point.at_px[1])}, point.address, verdict_of(reply, i)}));
  }
}

void OverlayNews::forget_old(const core::Sighting& sighting) {
  const bool tracks = sighting.state == core::TrackState::kTracking ||
                      sighting.state == core::TrackState::kDegraded;
  const bool refused = refusal_ != core::StartRefusal::kNone;
  if (sighting.time - start_at_ > kShown && (tracks || !refused)) {
    clicks_.clear();
    refusal_ = core::StartRefusal::kNone;
  }
  if (moves(sighting)) {
    clicks_.clear();
  }
  // A tube that was confirmed a while ago says nothing of the one that the tool is under now.
  const bool confirmed = claim_ && claim_->verdict == core::ClaimVerdict::kConfirmed;
  if (confirmed && !(sighting.tool_known && sighting.tool == claim_->claimed)) {
    claim_.reset();
  }
  const bool contradicted = claim_ && claim_->verdict == core::ClaimVerdict::kContradicted;
  if (!contradicted && sighting.time - claim_at_ > kShown) {
    claim_.reset();
  }
}

}  // namespace tubesight::board
