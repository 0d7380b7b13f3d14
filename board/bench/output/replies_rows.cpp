#include "board/bench/output/replies_rows.h"

#include <chrono>
#include <optional>
#include <variant>

#include "core/base/names.h"
#include "core/base/words.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using core::TubeAddress;

/// What differs between the kinds of answers.
struct Answer {
  std::string_view kind;
  std::string_view verdict;
  std::optional<TubeAddress> tube;
  std::optional<TubeAddress> claimed;
  std::int64_t judged_field = -1;
  std::string_view reason;
};

Answer answer_of(const core::ClaimReply& claim) {
  const bool known = claim.verdict != core::ClaimVerdict::kUnknown;
  return {"claim",
          core::name_of(claim.verdict),
          known ? std::optional(claim.tube) : std::nullopt,
          claim.claimed,
          claim.field,
          known ? std::string_view() : core::name_of(claim.doubt)};
}

Answer answer_of(const core::StartReply& start) {
  const bool taken = start.refusal == core::StartRefusal::kNone;
  return {"start", taken ? "taken" : "refused", {}, {}, -1, core::name_of(start.refusal)};
}

Answer answer_of(const core::PickReply& pick) {
  if (pick.doubt == core::PickDoubt::kNone) {
    return {"pick", "named", pick.tube, {}, -1, {}};
  }
  return {"pick", "unknown", {}, {}, -1, core::name_of(pick.doubt)};
}

Answer answer_of(const core::PoseRequestReply& request) {
  if (request.refusal == core::PoseReason::kNone) {
    return {};  // its pose follows
  }
  return {"pose", "refused", {}, {}, -1, core::name_of(request.refusal)};
}

Answer answer_of(const core::PoseReply& pose) {
  const bool named = pose.verdict == core::PoseVerdict::kConfirmed ||
                     pose.verdict == core::PoseVerdict::kContradicted;
  const bool refused = pose.verdict == core::PoseVerdict::kRefused;
  return {"pose",
          core::name_of(pose.verdict),
          named ? std::optional(pose.tube) : std::nullopt,
          {},
          -1,
          refused ? core::name_of(pose.pose.reason) : std::string_view()};
}

Answer answer_of(const core::LampReply&) { return {}; }
Answer answer_of(const core::NotServedReply&) { return {}; }

void append_address(std::string& out, const std::optional<TubeAddress>& tube) {
  out += ',';
  if (tube) {
    drivers::append_whole(out, tube->row);
  }
  out += ',';
  if (tube) {
    drivers::append_whole(out, tube->column);
  }
}

}  // namespace

void append_reply_row(std::string& out, std::int64_t field, const core::Reply& reply) {
  const Answer answer =
      std::visit([](const auto& content) { return answer_of(content); }, reply.content);
  if (answer.kind.empty()) {
    return;
  }
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  constexpr std::int32_t kDigits = 6;
  drivers::append_whole(out, field);
  out += ',';
  drivers::append_decimal(out, std::chrono::nanoseconds(reply.at).count(), kSecond_ns, kDigits);
  out += ',';
  out += answer.kind;
  out += ',';
  drivers::append_whole(out, reply.id);
  out += reply.origin == core::EventOrigin::kRobot ? ",robot," : ",operator,";
  out += answer.verdict;
  append_address(out, answer.tube);
  append_address(out, answer.claimed);
  out += ',';
  if (answer.judged_field >= 0) {
    drivers::append_whole(out, answer.judged_field);
  }
  out += ',';
  out += answer.reason;
  out += '\n';
}

}  // namespace tubesight::board
