// A session's state as a block of bytes.
//
//   magic     8 bytes
//   version   u32, of the block and of the arithmetic: whoever changes what a step computes, or
//             what a state means, raises it
//   scalar    u32, 0 fixed, 1 float, 2 double
//   shape     u64, StateShape of the body
//   settings  u64, settings_digest()
//   length    u64, of the body
//   body
//   check     u64, StateDigest of all before
#include <concepts>
#include <utility>

#include "core/base/sighting_state.h"
#include "core/base/state_stream.h"
#include "core/session/session.h"

namespace tubesight::core::session {
namespace {

constexpr std::uint64_t kMagic = 0x6574617473627574;  // "tubstate"
constexpr std::uint32_t kVersion = 3;
constexpr std::size_t kCheckBytes = 8;

/// What stands before the body.
struct Head {
  static constexpr std::size_t kBytes = 40;

  std::uint64_t magic = kMagic;
  std::uint32_t version = kVersion;
  std::uint32_t scalar = 0;
  std::uint64_t shape = 0;
  std::uint64_t settings = 0;
  std::uint64_t length = 0;

  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [magic_word, version_number, arithmetic, shape_digest, settings_of, bytes] = self;
    stream(magic_word, version_number, arithmetic, shape_digest, settings_of, bytes);
  }
};

template <Scalar S>
constexpr std::uint32_t scalar_number() {
  if constexpr (std::same_as<S, FixedPoint>) {
    return 0;
  } else {
    return sizeof(S) == sizeof(float) ? 1 : 2;
  }
}

std::uint64_t check_of(std::span<const std::byte> bytes) {
  StateDigest digest;
  digest.add(bytes);
  return digest.value();
}

}  // namespace

template <Scalar S, typename Margin>
template <typename Self, typename Stream>
void Session<S, Margin>::transfer(Self& self, Stream& stream) {
  // Model, map and digest are the settings'; the refusals are written and read within a step.
  auto& [model, map, tracker, state, judged_fields, last_judged, lamp_wanted, lighting, recent,
         claims, starts, poses, start_refusals, settings] = self;
  stream(tracker);
  stream.choice(state, TrackState::kLost);
  stream.number(judged_fields, 0, kMostCounted);
  stream(last_judged, lamp_wanted, lighting, recent, claims, starts, poses);
}

template <Scalar S, typename Margin>
Result<std::size_t> Session<S, Margin>::save(std::span<std::byte> into) const {
  if (into.size() < Head::kBytes + kCheckBytes) {
    return Unexpected(Error::kBufferTooSmall);
  }
  StateWriter body(into.subspan(Head::kBytes));
  transfer(*this, body);
  StateShape shape;
  transfer(*this, shape);
  Head head;
  head.scalar = scalar_number<S>();
  head.shape = shape.value();
  head.settings = settings_digest_;
  head.length = body.size();
  StateWriter front(into.first(Head::kBytes));
  front(head);
  const std::size_t checked = Head::kBytes + body.size();
  StateWriter back(into.subspan(checked));
  std::uint64_t check = check_of(into.first(checked));
  back(check);
  if (!body.good() || !front.good() || !back.good()) {
    return Unexpected(Error::kBufferTooSmall);
  }
  return checked + kCheckBytes;
}

template <Scalar S, typename Margin>
Result<void> Session<S, Margin>::restore(std::span<const std::byte> from) {
  // Whole before it is looked at: what follows of a damaged block would mislead.
  if (from.size() < Head::kBytes + kCheckBytes) {
    return Unexpected(Error::kDataLoss);
  }
  Head head;
  StateReader front(from.first(Head::kBytes));
  front(head);
  const std::size_t checked = from.size() - kCheckBytes;
  std::uint64_t check = 0;
  StateReader back(from.subspan(checked));
  back(check);
  if (head.magic != kMagic || head.length != checked - Head::kBytes ||
      check != check_of(from.first(checked))) {
    return Unexpected(Error::kDataLoss);
  }
  StateShape shape;
  transfer(std::as_const(*this), shape);
  if (head.version != kVersion || head.scalar != scalar_number<S>() ||
      head.shape != shape.value()) {
    return Unexpected(Error::kUnsupported);
  }
  if (head.settings != settings_digest_) {
    return Unexpected(Error::kInvalidArgument);
  }
  StateReader body(from.subspan(Head::kBytes, checked - Head::kBytes));
  transfer(*this, body);
  return body.good() && body.left() == 0 ? Result<void>() : Unexpected(Error::kOutOfRange);
}

#define TUBESIGHT_INSTANTIATE(S, Margin)                                             \
  template Result<std::size_t> Session<S, Margin>::save(std::span<std::byte>) const; \
  template Result<void> Session<S, Margin>::restore(std::span<const std::byte>);
TUBESIGHT_FOR_EACH_POLICY(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::session
