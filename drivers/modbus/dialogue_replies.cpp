// What the box answers, into the registers of a dialogue.

#include <chrono>
#include <cstddef>

#include "drivers/modbus/dialogue.h"
#include "drivers/modbus/encode.h"

namespace tubesight::drivers {

using core::FieldTime;

constexpr FieldTime kMillisecond = std::chrono::milliseconds(1);

void Dialogue::hear(const core::Reply& reply, FieldTime now) {
  if (claim_.waits && reply.id == claim_.ticket) {
    hear_claim(reply, now);
    return;
  }
  for (std::int32_t i = 0; i < kCommandBits; ++i) {
    if (reply.id != 0 && reply.id == tickets_[static_cast<std::size_t>(i)]) {
      hear_result(static_cast<CommandBit>(i), reply);
      return;
    }
  }
}

void Dialogue::hear_claim(const core::Reply& reply, FieldTime now) {
  const auto* const told = core::content_if<core::ClaimReply>(reply);
  if (told == nullptr || told->claimed != claim_.reply.claimed) {
    give_up_claim(now);
    return;
  }
  claim_.waits = false;
  claim_.told = true;
  claim_.told_at = now;
  claim_.reply = *told;
  claim_.reason = static_cast<std::int32_t>(told->doubt);
}

void Dialogue::give_up_claim(FieldTime now) {
  if (!claim_.waits) {
    return;
  }
  claim_.waits = false;
  claim_.told = true;
  claim_.told_at = now;
  claim_.reply.verdict = core::ClaimVerdict::kUnknown;
  claim_.reason = kNoAnswerInTime;
  ++state_->counters.late_claims;
}

void Dialogue::hear_result(CommandBit command, const core::Reply& reply) {
  using enum Register;
  const auto refuse = [this](Register result, Register reason, std::int32_t why) {
    image_.set(result, kResultRefused);
    image_.set(reason, why);
  };
  const auto not_served = [&] {
    switch (command) {
      case CommandBit::kStart: refuse(kStartResult, kStartReason, kNotServed); break;
      case CommandBit::kPick: refuse(kPickResult, kPickReason, kNotServed); break;
      case CommandBit::kLamp: image_.set(kLampResult, kResultRefused); break;
      case CommandBit::kPose:
        encode_pose({}, nullptr, image_);
        image_.set(kPoseReason, kNotServed);
        break;
      case CommandBit::kAcknowledge: break;
    }
  };
  if (const auto* const start = core::content_if<core::StartReply>(reply)) {
    const bool taken = start->refusal == core::StartRefusal::kNone;
    image_.set(kStartResult, taken ? kResultTaken : kResultRefused);
    image_.set(kStartReason, static_cast<std::int64_t>(start->refusal));
  } else if (const auto* const pick = core::content_if<core::PickReply>(reply)) {
    const bool named = pick->doubt == core::PickDoubt::kNone;
    image_.set(kPickResult, named ? kResultTaken : kResultRefused);
    image_.set(kPickReason, static_cast<std::int64_t>(pick->doubt));
    if (named) {
      image_.set(kPickRow, pick->tube.row);
      image_.set(kPickColumn, pick->tube.column);
    }
  } else if (const auto* const lamp = core::content_if<core::LampReply>(reply)) {
    image_.set(kLampResult, kResultTaken);
    image_.set(kLampTaken, lamp->permille);
  } else if (const auto* const asked = core::content_if<core::PoseRequestReply>(reply)) {
    if (asked->refusal == core::PoseReason::kNone) {
      return;  // the result is to come, under the same id
    }
    core::PoseReply refused;
    refused.pose.reason = asked->refusal;
    encode_pose(refused, nullptr, image_);
  } else if (const auto* const pose = core::content_if<core::PoseReply>(reply)) {
    encode_pose(*pose, state_->sighting ? &*state_->sighting : nullptr, image_);
  } else {
    not_served();
  }
  finish(command, image_);
}

void Dialogue::encode_verdict(FieldTime now) {
  using enum Register;
  if (claim_.waits && now - claim_.taken > kClaimWaits) {
    give_up_claim(now);
  }
  const FieldTime since = now - claim_.told_at;
  const bool told = claim_.told && since <= kVerdictLasts && since >= -kVerdictLasts;
  encode_claim(told);
  if (told) {
    static_cast<void>(
        image_.set_scaled(kVerdictAge, (now - claim_.at).count(), kMillisecond.count()));
  }
  image_.set(kVerdictSequence, verdict_sequence_);
  image_.set(kVerdictSequenceAgain, verdict_sequence_);
}

void Dialogue::encode_claim(bool told) {
  using enum Register;
  constexpr std::int32_t kToldBit = 1;
  constexpr std::int32_t kTubeBit = 2;
  constexpr std::int32_t kWaitsBit = 4;
  for (const Register name : {kVerdictId, kVerdictClaimedRow, kVerdictClaimedColumn,
                              kVerdictTubeRow, kVerdictTubeColumn, kVerdictField, kVerdictAge}) {
    image_.set_unknown(name);
  }
  image_.set(kVerdict, 0);
  image_.set(kVerdictReason, 0);
  image_.set(kVerdictValid, claim_.waits ? kWaitsBit : 0);
  if (!told) {
    return;
  }
  const core::ClaimReply& reply = claim_.reply;
  const bool tube = reply.verdict != core::ClaimVerdict::kUnknown;
  image_.set(kVerdict, static_cast<std::int64_t>(code_of(reply.verdict)));
  image_.set(kVerdictReason, claim_.reason);
  image_.set(kVerdictId, claim_.id);
  image_.set(kVerdictClaimedRow, reply.claimed.row);
  image_.set(kVerdictClaimedColumn, reply.claimed.column);
  image_.set(kVerdictField, reply.field);
  if (tube) {
    image_.set(kVerdictTubeRow, reply.tube.row);
    image_.set(kVerdictTubeColumn, reply.tube.column);
  }
  image_.set(kVerdictValid, kToldBit + (tube ? kTubeBit : 0));
}

}  // namespace tubesight::drivers
