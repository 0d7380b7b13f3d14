#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/reply.h"
#include "drivers/modbus/link_state.h"
#include "drivers/modbus/outbox.h"
#include "drivers/modbus/register_codes.h"
#include "drivers/modbus/register_image.h"

namespace tubesight::drivers {

/// Modbus's exceptions, as far as the link has them.
enum class Refusal : std::uint8_t {
  kNone = 0,
  kIllegalFunction = 1,
  kIllegalAddress = 2,
  kIllegalValue = 3,
  kBusy = 6,  ///< too many requests wait for the loop, or a claim came while one waited: ask again
};

/// Longest that a claim waits for its verdict: the field that judges it, 50 ms, and some; 55 ms
/// with the sending.
inline constexpr core::FieldTime kClaimWaits = std::chrono::milliseconds(54);

/// Time for which a verdict can be read.
inline constexpr core::FieldTime kVerdictLasts = std::chrono::seconds(1);

/// What one master and the box have to say to each other, in registers.
///
/// Turns what is written into events and replies into what is read. Every master has a dialogue of
/// its own, so that none reads the answer to another. A write is taken whole or refused whole. One
/// thread; no heap; some 2 KB.
class Dialogue {
 public:
  /// `state` and `outbox` outlive the dialogue.
  Dialogue(WordOrder order, LinkState& state, Outbox& outbox);

  /// Forgets all that was said: another master begins.
  void reset();

  [[nodiscard]] static Refusal check_readable(std::int32_t first, std::int32_t count);
  /// Copies registers as they are at `now`; needs them readable.
  void read(std::int32_t first, core::FieldTime now, std::span<std::uint16_t> words);

  /// Takes registers that arrived at an instant, and does what they command.
  [[nodiscard]] Refusal write(std::int32_t first, std::span<const std::uint16_t> words,
                              core::FieldTime arrival);

  /// Until told otherwise claims are refused as kBusy: when they came is not known.
  void refuse_claims(bool on) { refuses_claims_ = on; }

  /// Takes an answer of the box if it belongs to this dialogue; others leave it as it is.
  void hear(const core::Reply& reply, core::FieldTime now);

  /// Whether a claim has no verdict yet.
  [[nodiscard]] bool claim_waits() const { return claim_.waits; }

  /// Grows with each claim taken.
  [[nodiscard]] std::uint32_t claims_taken() const { return verdict_sequence_; }

  /// The claim that waits gets none any more: CANNOT SAY, and its answer will not be heard.
  void give_up_claim(core::FieldTime now);

 private:
  /// The latest claim and its verdict.
  struct ClaimState {
    bool waits = false;
    bool told = false;
    std::int64_t ticket = 0;
    std::int32_t id = 0;
    core::FieldTime at{0};     ///< its instant
    core::FieldTime taken{0};  ///< when it came
    core::FieldTime told_at{0};
    core::ClaimReply reply;
    std::int32_t reason = 0;
  };

  [[nodiscard]] Refusal take(Block block, RegisterImage& next, core::FieldTime arrival);
  [[nodiscard]] Refusal take_claim(RegisterImage& next, core::FieldTime arrival);
  [[nodiscard]] Refusal take_commands(RegisterImage& next, core::FieldTime arrival);
  void begin(CommandBit command, RegisterImage& next, core::FieldTime arrival);
  void begin_start(RegisterImage& next, core::FieldTime arrival);
  void clear_result(CommandBit command, RegisterImage& next) const;
  [[nodiscard]] bool window_is_ours(const RegisterImage& next) const;
  void finish(CommandBit command, RegisterImage& next);
  void hear_claim(const core::Reply& reply, core::FieldTime now);
  void hear_result(CommandBit command, const core::Reply& reply);
  void encode_verdict(core::FieldTime now);
  void encode_claim(bool told);

  LinkState* state_;
  OutboxShare outbox_;
  RegisterImage image_;
  ClaimState claim_;
  bool refuses_claims_ = false;
  std::uint32_t verdict_sequence_ = 0;
  std::array<std::int64_t, kCommandBits> tickets_{};  ///< of the commands under way; 0: none
};

}  // namespace tubesight::drivers
