#include "drivers/modbus/dialogue.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <variant>

#include "core/base/assert.h"
#include "core/base/settings.h"
#include "drivers/modbus/encode.h"

namespace tubesight::drivers {
namespace {

using core::FieldTime;

constexpr double kPixel = 1000.0;  // in u and v
constexpr std::int32_t kMostPixels = 32767 * 1000;
constexpr std::int32_t kOldestClaim_ms = 10'000;

const RegisterBlock* block_of(std::int32_t first, std::int32_t count) {
  for (const RegisterBlock& block : register_blocks()) {
    if (count > 0 && block.holds(first, count)) {
      return &block;
    }
  }
  return nullptr;
}

/// The register that stands `steps` values after another.
Register after(Register name, std::int32_t steps) {
  return static_cast<Register>(static_cast<std::int32_t>(name) + steps);
}

bool in_picture(const RegisterImage& image, Register u) {
  return std::ranges::all_of(std::array{image.get(u), image.get(after(u, 1))},
                             [](std::int32_t at) { return at >= 0 && at <= kMostPixels; });
}

std::array<double, 2> place(const RegisterImage& image, Register u) {
  return {image.get(u) / kPixel, image.get(after(u, 1)) / kPixel};
}

std::optional<std::int64_t> seen_field(const RegisterImage& image) {
  const std::int32_t field = image.get(Register::kSeenField);
  return field >= 0 ? std::optional<std::int64_t>(field) : std::nullopt;
}

constexpr std::int32_t kStartTubes = 3;
constexpr std::int32_t kValuesOfTube = 4;  // row, column, u, v

Register start_tube(std::int32_t i) { return after(Register::kStart1Row, i * kValuesOfTube); }

constexpr std::int32_t kFarthestRobot = 100'000 * 10'000;  // mm
constexpr std::int32_t kLargestTurn = 360 * 100'000;       // degrees
constexpr std::int32_t kLargestJoint = 720 * 100'000;

bool within(const RegisterImage& image, Register first, std::int32_t values, std::int32_t most) {
  for (std::int32_t i = 0; i < values; ++i) {
    const std::int32_t value = image.get(after(first, i));
    if (value < -most || value > most) {
      return false;
    }
  }
  return true;
}

/// Whether what is told of the robot's own pose is within its limits.
bool is_robot_sound(const RegisterImage& next) {
  const std::int32_t told = next.get(Register::kRobotTold);
  const std::int32_t joints = next.get(Register::kRobotJoints);
  if (told > kRobotTurned || joints > core::kMaxToldJoints) {
    return false;
  }
  return told == kRobotNothing ||
         (within(next, Register::kRobotX, 3, kFarthestRobot) &&
          (told == kRobotPlace || within(next, Register::kRobotAlpha, 3, kLargestTurn)) &&
          within(next, Register::kRobotJoint1, joints, kLargestJoint));
}

/// What is told goes with one request: the next one's pose is another.
core::PoseRequest take_robot_pose(RegisterImage& next) {
  using enum Register;
  constexpr std::int64_t kNanometres = 100;      // in 1/10000 mm
  constexpr std::int64_t kNanodegrees = 10'000;  // in 1/100000 degree
  core::PoseRequest request;
  if (const std::int32_t told = next.get(kRobotTold); told != kRobotNothing) {
    core::RobotPose& robot = request.robot.emplace();
    robot.turned = told == kRobotTurned;
    for (std::int32_t i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      robot.position_nm[at] = kNanometres * next.get(after(kRobotX, i));
      robot.angles_ndeg[at] = robot.turned ? kNanodegrees * next.get(after(kRobotAlpha, i)) : 0;
    }
    robot.joints = next.get(kRobotJoints);
    for (std::int32_t i = 0; i < robot.joints; ++i) {
      robot.joints_ndeg[static_cast<std::size_t>(i)] =
          kNanodegrees * next.get(after(kRobotJoint1, i));
    }
  }
  next.set(kRobotTold, kRobotNothing);
  next.set(kRobotJoints, 0);
  return request;
}

bool has(std::int32_t bits, CommandBit command) { return (bits & bit_of(command)) != 0; }

/// Whether what the commands that begin are given is within its limits.
bool is_sound(const RegisterImage& next, std::int32_t begun) {
  if (next.get(Register::kCommand) >= 1 << kCommandBits || next.get(Register::kStartConfirm) > 1 ||
      next.get(Register::kLampLevel) > core::kFullLamp_permille ||
      (next.get(Register::kLampMode) != kLampCommanded &&
       next.get(Register::kLampMode) != kLampAutomatic)) {
    return false;
  }
  if (has(begun, CommandBit::kStart)) {
    for (std::int32_t i = 0; i < kStartTubes; ++i) {
      if (!in_picture(next, after(start_tube(i), 2))) {
        return false;
      }
    }
  }
  if (has(begun, CommandBit::kPick) && !in_picture(next, Register::kPickU)) {
    return false;
  }
  return begun == 0 || next.get(Register::kSeenField) >= -1;
}

constexpr std::array kCommands{CommandBit::kStart, CommandBit::kPick, CommandBit::kLamp,
                               CommandBit::kPose, CommandBit::kAcknowledge};

}  // namespace

Dialogue::Dialogue(WordOrder order, LinkState& state, Outbox& outbox)
    : state_(&state), outbox_(outbox), image_(order) {
  reset();
}

void Dialogue::reset() {
  using enum Register;
  claim_ = {};
  verdict_sequence_ = 0;
  tickets_.fill(0);
  for (std::int32_t address = 0; address < kMapWords; ++address) {
    image_.set_word(address, 0);
  }
  encode_identity(state_->identity, image_);
  for (const CommandBit command : kCommands) {
    clear_result(command, image_);
  }
  image_.set(kSeenField, -1);
  image_.set(kLampLevel, core::kFullLamp_permille);
  image_.set(kLampMode, kLampCommanded);
  for (std::int32_t i = 0; i < 4; ++i) {
    image_.set(after(kWindowLeft, i), state_->identity.window_px[static_cast<std::size_t>(i)]);
  }
  image_.set(kOptimumU, std::llround(state_->identity.optimum_px[0] * kPixel));
  image_.set(kOptimumV, std::llround(state_->identity.optimum_px[1] * kPixel));
}

Refusal Dialogue::check_readable(std::int32_t first, std::int32_t count) {
  return block_of(first, count) != nullptr ? Refusal::kNone : Refusal::kIllegalAddress;
}

void Dialogue::read(std::int32_t first, FieldTime now, std::span<std::uint16_t> words) {
  const RegisterBlock* const block = block_of(first, static_cast<std::int32_t>(words.size()));
  TUBESIGHT_ASSERT(block != nullptr);
  if (block->name == Block::kSighting) {
    encode_sighting(*state_, now, image_);
  } else if (block->name == Block::kVerdict) {
    encode_verdict(now);
  } else if (block->name == Block::kHealth) {
    encode_health(*state_, image_);
  } else if (block->name == Block::kSelfTest) {
    encode_self_test(state_->self_test, image_);
  } else if (block->name == Block::kJournal) {
    encode_journal(state_->journal, image_);
  } else if (block->name == Block::kZone) {
    encode_zone(state_->identity.zones,
                {image_.get(Register::kZoneTubeRow), image_.get(Register::kZoneTubeColumn)},
                image_);
  }
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = image_.word(first + static_cast<std::int32_t>(i));
  }
}

Refusal Dialogue::write(std::int32_t first, std::span<const std::uint16_t> words,
                        FieldTime arrival) {
  const RegisterBlock* const block = block_of(first, static_cast<std::int32_t>(words.size()));
  if (block == nullptr || !block->writable) {
    return Refusal::kIllegalAddress;
  }
  RegisterImage next = image_;
  for (std::size_t i = 0; i < words.size(); ++i) {
    next.set_word(first + static_cast<std::int32_t>(i), words[i]);
  }
  const Refusal refusal = take(block->name, next, arrival);
  if (refusal == Refusal::kNone) {
    image_ = next;
  } else if (refusal == Refusal::kBusy) {
    ++state_->counters.dropped_events;
  }
  return refusal;
}

Refusal Dialogue::take(Block block, RegisterImage& next, FieldTime arrival) {
  switch (block) {
    case Block::kClaim: return take_claim(next, arrival);
    case Block::kZoneTube: return Refusal::kNone;  // any tube may be asked for
    case Block::kRobot: return is_robot_sound(next) ? Refusal::kNone : Refusal::kIllegalValue;
    default: return take_commands(next, arrival);
  }
}

Refusal Dialogue::take_claim(RegisterImage& next, FieldTime arrival) {
  using enum Register;
  const std::int32_t commit = next.get(kClaimCommit);
  if (commit > 1 || next.get(kClaimAge) > kOldestClaim_ms) {
    return Refusal::kIllegalValue;
  }
  if (commit == 0) {
    return Refusal::kNone;
  }
  if (refuses_claims_ || !outbox_.has_room(1, OutboxShare::kMostClaims)) {
    return Refusal::kBusy;
  }
  claim_ = {};
  claim_.waits = true;
  claim_.id = next.get(kClaimId);
  claim_.taken = arrival;
  claim_.at = arrival - std::chrono::milliseconds(next.get(kClaimAge));
  claim_.reply.claimed = {next.get(kClaimRow), next.get(kClaimColumn)};
  claim_.ticket = outbox_.send(core::Claim{claim_.reply.claimed}, claim_.id, claim_.at);
  verdict_sequence_ = verdict_sequence_ == UINT32_MAX ? 1 : verdict_sequence_ + 1;
  next.set(kClaimAge, 0);
  next.set(kClaimCommit, 0);
  return Refusal::kNone;
}

Refusal Dialogue::take_commands(RegisterImage& next, FieldTime arrival) {
  const std::int32_t before = image_.get(Register::kCommand);
  const std::int32_t after_it = next.get(Register::kCommand);
  const std::int32_t begun = after_it & ~before;
  if (!is_sound(next, begun)) {
    return Refusal::kIllegalValue;
  }
  if (begun != 0 && !outbox_.has_room(std::popcount(static_cast<std::uint32_t>(begun)),
                                      OutboxShare::kMostEvents)) {
    return Refusal::kBusy;
  }
  for (const CommandBit command : kCommands) {
    if (has(before & ~after_it, command)) {
      tickets_[static_cast<std::size_t>(command)] = 0;
      clear_result(command, next);
    }
  }
  for (const CommandBit command : kCommands) {
    if (has(begun, command)) {
      begin(command, next, arrival);
    }
  }
  return Refusal::kNone;
}

void Dialogue::begin(CommandBit command, RegisterImage& next, FieldTime arrival) {
  using enum Register;
  const std::int32_t id = next.get(kCommandId);
  std::int64_t& ticket = tickets_[static_cast<std::size_t>(command)];
  next.set(kBusy, next.get(kBusy) | bit_of(command));
  switch (command) {
    case CommandBit::kStart:
      next.set(kStartId, id);
      begin_start(next, arrival);
      next.set(kStartConfirm, 0);  // who insisted on this start did not insist on the next
      break;
    case CommandBit::kPick:
      next.set(kPickId, id);
      next.set(kPickAtU, next.get(kPickU));
      next.set(kPickAtV, next.get(kPickV));
      ticket = outbox_.send(core::Pick{place(next, kPickU), seen_field(next)}, id, arrival);
      break;
    case CommandBit::kLamp:
      next.set(kLampId, id);
      ticket = outbox_.send(
          core::LampCommand{next.get(kLampLevel), next.get(kLampMode) == kLampAutomatic}, id,
          arrival);
      break;
    case CommandBit::kPose:
      next.set(kPoseId, id);
      ticket = outbox_.send(take_robot_pose(next), id, arrival);
      break;
    case CommandBit::kAcknowledge:
      claim_ = {};
      finish(command, next);
      break;
  }
}

void Dialogue::begin_start(RegisterImage& next, FieldTime arrival) {
  using enum Register;
  if (!window_is_ours(next)) {
    next.set(kStartResult, kResultRefused);
    next.set(kStartReason, kOtherWindow);
    finish(CommandBit::kStart, next);
    return;
  }
  core::Start start;
  for (std::int32_t i = 0; i < kStartTubes; ++i) {
    const Register row = start_tube(i);
    static_cast<void>(start.tubes.try_push_back(
        {{next.get(row), next.get(after(row, 1))}, place(next, after(row, 2))}));
  }
  start.seen_field = seen_field(next);
  start.confirmed = next.get(kStartConfirm) == 1;
  tickets_[static_cast<std::size_t>(CommandBit::kStart)] =
      outbox_.send(start, next.get(kCommandId), arrival);
}

/// The session has one window, that of its settings: a robot that wants another must hear of it.
bool Dialogue::window_is_ours(const RegisterImage& next) const {
  using enum Register;
  const LinkIdentity& ours = state_->identity;
  for (std::int32_t i = 0; i < 4; ++i) {
    if (next.get(after(kWindowLeft, i)) != ours.window_px[static_cast<std::size_t>(i)]) {
      return false;
    }
  }
  return next.get(kOptimumU) == std::llround(ours.optimum_px[0] * kPixel) &&
         next.get(kOptimumV) == std::llround(ours.optimum_px[1] * kPixel);
}

void Dialogue::finish(CommandBit command, RegisterImage& next) {
  tickets_[static_cast<std::size_t>(command)] = 0;
  next.set(Register::kBusy, next.get(Register::kBusy) & ~bit_of(command));
  next.set(Register::kAcknowledge, next.get(Register::kAcknowledge) | bit_of(command));
}

void Dialogue::clear_result(CommandBit command, RegisterImage& next) const {
  using enum Register;
  next.set(kBusy, next.get(kBusy) & ~bit_of(command));
  next.set(kAcknowledge, next.get(kAcknowledge) & ~bit_of(command));
  switch (command) {
    case CommandBit::kStart:
      next.set(kStartResult, 0);
      next.set(kStartReason, 0);
      next.set_unknown(kStartId);
      break;
    case CommandBit::kPick:
      next.set(kPickResult, 0);
      next.set(kPickReason, 0);
      for (const Register name : {kPickId, kPickAtU, kPickAtV, kPickRow, kPickColumn}) {
        next.set_unknown(name);
      }
      break;
    case CommandBit::kLamp:
      next.set(kLampResult, 0);
      next.set_unknown(kLampTaken);
      next.set_unknown(kLampId);
      break;
    case CommandBit::kPose:
      clear_pose(next);
      next.set_unknown(kPoseId);
      break;
    case CommandBit::kAcknowledge: break;
  }
}

}  // namespace tubesight::drivers
