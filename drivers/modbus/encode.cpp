#include "drivers/modbus/encode.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "drivers/modbus/register_codes.h"

namespace tubesight::drivers {
namespace {

using core::FieldTime;
using core::Sighting;

constexpr std::int64_t kMicrometres_q8 = 256 * 1000;  // in a millimetre
constexpr std::int64_t kMicrometres = 1000;
constexpr std::int64_t kNanometres = 1'000'000;
constexpr std::int64_t kNanodegrees = 1'000'000'000;
constexpr std::int64_t kPixels_q16 = 65536;
constexpr std::int64_t kPermyriad = 10000;
constexpr std::int64_t kNanoseconds = 1'000'000;  // in a millisecond

/// Says what a bit of validity covers: the bit is set only if every value of it is known and fits.
class Validity {
 public:
  explicit Validity(RegisterImage& image) : image_(&image) {}

  void value(Register name, bool known, std::int64_t value, std::int64_t per_unit = 1) {
    if (!known) {
      image_->set_unknown(name);
      whole_ = false;
    } else if (!image_->set_scaled(name, value, per_unit)) {
      whole_ = false;
    }
  }

  /// Ends a group of values: its bit.
  template <typename Bit>
  void bit(Bit bit) {
    bits_ |= bit_of(bit, whole_);
    whole_ = true;
  }

  [[nodiscard]] std::int32_t bits() const { return bits_; }

 private:
  RegisterImage* image_;
  std::int32_t bits_ = 0;
  bool whole_ = true;
};

/// Bits of a block whose groups have no names of their own are counted.
enum class Bit : std::uint8_t { k0, k1, k2, k3, k4, k5 };

void encode_place(const Sighting& s, bool current, Validity& valid) {
  using enum Register;
  const bool primary = current && s.primary_known;
  valid.value(kPrimaryRow, primary, s.primary.row);
  valid.value(kPrimaryColumn, primary, s.primary.column);
  valid.value(kPrimaryU, primary, s.primary_px.u_q16, kPixels_q16);
  valid.value(kPrimaryV, primary, s.primary_px.v_q16, kPixels_q16);
  valid.bit(SightingBit::kPrimary);
  const bool tool = current && s.tool_known;
  valid.value(kTubeRow, tool, s.tool.row);
  valid.value(kTubeColumn, tool, s.tool.column);
  valid.value(kOffset, tool, s.offset_um_q8, kMicrometres_q8);
  valid.value(kOffsetX, tool, s.displacement_um_q8[0], kMicrometres_q8);
  valid.value(kOffsetY, tool, s.displacement_um_q8[1], kMicrometres_q8);
  valid.bit(SightingBit::kTube);
  const bool axis = current && s.axis_known;
  valid.value(kHeight, axis, s.height_um_q8, kMicrometres_q8);
  valid.value(kAxisU, axis, s.axis_px.u_q16, kPixels_q16);
  valid.value(kAxisV, axis, s.axis_px.v_q16, kPixels_q16);
  valid.bit(SightingBit::kAxis);
  valid.value(kMargin, current && s.margin_known, s.margin_permyriad, kPermyriad);
  valid.bit(SightingBit::kMargin);
  valid.value(kVelocityX, current && s.velocity_known, s.velocity_um_s[0], kMicrometres);
  valid.value(kVelocityY, current && s.velocity_known, s.velocity_um_s[1], kMicrometres);
  valid.bit(SightingBit::kVelocity);
}

/// Rz(alpha) Ry(beta) Rx(gamma), transposed, times a vector of the sheet: the vector in the tool's
/// own axes.
std::array<double, 3> in_tool(const std::array<std::int64_t, 3>& angles_ndeg,
                              const std::array<double, 3>& v) {
  const auto radians = [](std::int64_t ndeg) {
    return static_cast<double>(ndeg) * (std::numbers::pi / 180e9);
  };
  const auto turned = [](double angle, double x, double y) {
    return std::array<double, 2>{std::cos(angle) * x + std::sin(angle) * y,
                                 std::cos(angle) * y - std::sin(angle) * x};
  };
  const auto [x1, y1] = turned(radians(angles_ndeg[0]), v[0], v[1]);  // Rz^T
  const auto [z2, x2] = turned(radians(angles_ndeg[1]), v[2], x1);    // Ry^T
  const auto [y3, z3] = turned(radians(angles_ndeg[2]), y1, z2);      // Rx^T
  return {x2, y3, z3};
}

/// Lean and height stay; the sheet's plane is z = 0, so the move is the displacement, undone.
void encode_correction(const core::PoseReply& reply, const Sighting* seen, Validity& valid) {
  const bool known = reply.verdict == core::PoseVerdict::kConfirmed && seen != nullptr &&
                     seen->judged && seen->tool_known && seen->tool == reply.tube;
  std::array<double, 3> move_um{};
  if (known) {
    constexpr double kQ8 = 256.0;
    move_um = in_tool(reply.pose.angles_ndeg, {-seen->displacement_um_q8[0] / kQ8,
                                               -seen->displacement_um_q8[1] / kQ8, 0.0});
  }
  constexpr std::array kNames{Register::kCorrectionX, Register::kCorrectionY,
                              Register::kCorrectionZ};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    valid.value(kNames[i], known, std::llround(move_um[i] * 1000.0), kNanometres);
  }
}

}  // namespace

void encode_identity(const LinkIdentity& identity, RegisterImage& image) {
  using enum Register;
  Validity valid(image);
  valid.value(kCameraId, identity.camera_id.has_value(), identity.camera_id.value_or(0));
  valid.bit(Bit::k0);
  valid.value(kToolId, identity.tool_id.has_value(), identity.tool_id.value_or(0));
  valid.bit(Bit::k1);
  valid.value(kBaseId, identity.base_id.has_value(), identity.base_id.value_or(0));
  valid.bit(Bit::k2);
  image.set(kMapVersion, kPresentMapVersion);
  image.set(kIdentityValid, valid.bits());
  image.set(kWordOrderMark, kWordOrderPattern);
  image.set(kProduct, kProductPattern);
  image.set(kProductVersion, identity.product_version);
  for (const Register boot : {kBoot, kSightingBoot, kVerdictBoot, kResultBoot}) {
    image.set(boot, identity.boot);
  }
}

void encode_health(const LinkState& state, RegisterImage& image) {
  using enum Register;
  const LinkHealth& health = state.health;
  Validity valid(image);
  const auto told = [&valid](Register name, Health part) {
    valid.value(name, part != Health::kUnknown, static_cast<std::int64_t>(part));
  };
  told(kCameraHealth, health.camera);
  valid.bit(Bit::k0);
  told(kLampHealth, health.lamp);
  valid.bit(Bit::k1);
  const auto pattern = state.sighting ? state.sighting->liveness : core::Liveness::kUnknown;
  valid.value(kLampPattern, pattern != core::Liveness::kUnknown,
              static_cast<std::int64_t>(pattern));
  valid.bit(Bit::k2);
  valid.value(kLampNow, health.lamp_permille >= 0, health.lamp_permille);
  valid.bit(Bit::k3);
  image.set(kLampModeNow, !health.lamp_dimmed     ? 0
                          : health.lamp_automatic ? kLampAutomatic
                                                  : kLampCommanded);
  valid.value(kFields, health.fields >= 0, health.fields & INT32_MAX);
  valid.value(kFieldsMissing, health.fields_missing >= 0, health.fields_missing & INT32_MAX);
  valid.value(kFieldsLate, health.fields_late >= 0, health.fields_late & INT32_MAX);
  valid.bit(Bit::k4);
  valid.value(kPairsWritten, health.pairs_written >= 0, health.pairs_written & INT32_MAX);
  valid.value(kPairsLost, health.pairs_lost >= 0, health.pairs_lost & INT32_MAX);
  valid.bit(Bit::k5);
  image.set(kHealthValid, valid.bits());

  const LinkCounters& counters = state.counters;
  image.set(kRequests, counters.requests);
  image.set(kAnswers, counters.answers);
  image.set(kExceptions, counters.exceptions);
  image.set(kCrcErrors, counters.crc_errors);
  image.set(kCutFrames, counters.cut_frames);
  image.set(kOtherUnits, counters.other_units);
  image.set(kBroadcasts, counters.broadcasts);
  image.set(kStrayBytes, counters.stray_bytes);
  image.set(kDroppedEvents, counters.dropped_events);
  image.set(kLateClaims, counters.late_claims);
  image.set(kAbandonedAnswers, counters.abandoned_answers);
  image.set(kReopenings, counters.reopenings);
  image.set(kResponseLast, counters.response_last_us);
  image.set(kResponseWorst, counters.response_worst_us);
  image.set(kClaimResponseWorst, counters.claim_response_worst_us);
}

void encode_journal(const LinkJournal& journal, RegisterImage& image) {
  using enum Register;
  image.set(kJournal, journal.state);
  image.set(kJournalReserved, 0);
  image.set(kJournalSafe, journal.safe & INT32_MAX);
  image.set(kJournalWaiting, journal.waiting & INT32_MAX);
  image.set(kJournalLost, journal.lost & INT32_MAX);
}

void encode_self_test(const LinkSelfTest& self_test, RegisterImage& image) {
  using enum Register;
  image.set(kSelfTest, static_cast<std::int64_t>(self_test.verdict));
  image.set(kSelfTestBad, self_test.bad);
  image.set(kSelfTestAbsent, self_test.absent);
  image.set(kSelfTestReserved, 0);
  Validity numbers(image);
  numbers.value(kBootNumber, self_test.boot > 0, self_test.boot);
  numbers.value(kStartNumber, self_test.start > 0, self_test.start);
  image.set(kUp, self_test.up_s & INT32_MAX);
}

void encode_sighting(const LinkState& state, FieldTime now, RegisterImage& image) {
  using enum Register;
  const Sighting& s = state.sighting ? *state.sighting : Sighting{};
  const FieldTime old = now - s.time;
  // A field of the future is one of another clock.
  const bool fresh = state.sighting && old <= kSightingLasts && old >= -kSightingLasts;
  const FieldTime judged_old = old + s.age;
  const bool seen = fresh && s.judged_fields > 0;
  const bool current = seen && judged_old <= kSightingLasts;
  Validity valid(image);
  valid.value(kState, fresh, code_of(s.state));
  valid.value(kReason, fresh, static_cast<std::int64_t>(s.reason));
  valid.value(kField, fresh, s.field);
  valid.value(kTracked, fresh, s.tracked);
  valid.value(kAligned, fresh, current && s.judged && s.tool_known && s.aligned ? 1 : 0);
  valid.value(kSightingAge, fresh, old < FieldTime(0) ? 0 : old.count(), kNanoseconds);
  valid.bit(SightingBit::kSighting);
  if (fresh && s.judged) {
    valid.bit(SightingBit::kJudged);
  }
  valid.value(kAge, seen, judged_old < FieldTime(0) ? 0 : judged_old.count(), kNanoseconds);
  valid.bit(SightingBit::kAge);
  encode_place(s, current, valid);
  valid.value(kLiveness, fresh && s.liveness != core::Liveness::kUnknown,
              static_cast<std::int64_t>(s.liveness));
  valid.bit(SightingBit::kLiveness);
  valid.value(kResidual, current && s.judged, s.residual_px_q16, kPixels_q16);
  valid.bit(SightingBit::kResidual);
  image.set(kSightingValid, valid.bits());
  image.set(kJudgedFields, s.judged_fields);
  image.set(kSequence, state.sequence);
  image.set(kSequenceAgain, state.sequence);
}

void encode_zone(const ZoneCorrections* zones, core::TubeAddress tube, RegisterImage& image) {
  using enum Register;
  ZoneAnswer answer;
  const bool known = zones != nullptr && zones->at(tube, answer);
  Validity valid(image);
  valid.value(kZoneX, known, answer.off_nm[0], kNanometres);
  valid.value(kZoneY, known, answer.off_nm[1], kNanometres);
  valid.value(kZoneZ, known, answer.off_nm[2], kNanometres);
  valid.value(kZoneSigmaAcross, known, answer.across_nm, kNanometres);
  valid.value(kZoneSigmaAlong, known, answer.along_nm, kNanometres);
  valid.bit(Bit::k0);
  image.set(kZoneValid, valid.bits());
  image.set(kZoneReserved, 0);
  image.set(kZoneRow, tube.row);
  image.set(kZoneColumn, tube.column);
}

void clear_pose(RegisterImage& image) {
  core::PoseReply none;
  encode_pose(none, nullptr, image);
  image.set(Register::kPoseResult, 0);
  image.set(Register::kPoseReason, 0);
}

void encode_pose(const core::PoseReply& reply, const Sighting* seen, RegisterImage& image) {
  using enum Register;
  const bool known = reply.verdict != core::PoseVerdict::kRefused;
  Validity valid(image);
  const auto three = [&](Register first, const std::array<std::int64_t, 3>& values,
                         std::int64_t per_unit) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      valid.value(static_cast<Register>(static_cast<std::size_t>(first) + i), known, values[i],
                  per_unit);
    }
  };
  three(kPoseX, reply.pose.position_nm, kNanometres);
  three(kPoseAlpha, reply.pose.angles_ndeg, kNanodegrees);
  three(kPoseSigmaX, reply.pose.position_sigma_nm, kNanometres);
  three(kPoseSigmaAlpha, reply.pose.angle_sigma_ndeg, kNanodegrees);
  valid.value(kPoseTubes, known, reply.pose.tubes);
  valid.bit(Bit::k0);
  const bool tube = reply.verdict == core::PoseVerdict::kConfirmed ||
                    reply.verdict == core::PoseVerdict::kContradicted;
  valid.value(kPoseTubeRow, tube, reply.tube.row);
  valid.value(kPoseTubeColumn, tube, reply.tube.column);
  valid.bit(Bit::k1);
  encode_correction(reply, seen, valid);
  valid.bit(Bit::k2);
  image.set(kPoseValid, valid.bits());
  image.set(kPoseResult, code_of(reply.verdict));
  image.set(kPoseReason, static_cast<std::int64_t>(reply.pose.reason));
}

}  // namespace tubesight::drivers
