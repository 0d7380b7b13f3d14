#include "board/visionbox/link_identity.h"

#include <chrono>

#include <sys/random.h>
#include <unistd.h>

#include "board/box/version.h"
#include "drivers/settings/session_text.h"

namespace tubesight::board {
namespace {

/// Spreads each bit over all (the finalizer of SplitMix64).
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits ^ bits >> 30) * 0xBF58'476D'1CE4'E5B9U;
  bits = (bits ^ bits >> 27) * 0x94D0'49BB'1331'11EBU;
  return bits ^ bits >> 31;
}

}  // namespace

std::int32_t version_number(std::string_view version) {
  std::int32_t number = 0;
  std::int32_t part = 0;
  std::int32_t weight = 10'000;
  for (const char c : version) {
    if (c >= '0' && c <= '9') {
      part = 10 * part + (c - '0');
    } else if (c == '.' && weight > 1) {
      number += weight * part;
      part = 0;
      weight /= 100;
    } else {
      break;
    }
  }
  return number + weight * part;
}

/// Time and process make it another one; a board without a battery begins each day at the same
/// time, with the same processes, so that the kernel's dice are thrown in.
std::int32_t draw_boot_number() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  std::uint64_t dice = 0;
  static_cast<void>(getrandom(&dice, sizeof dice, GRND_NONBLOCK) == 0);
  const std::uint64_t bits = spread(spread(static_cast<std::uint64_t>(now.count()) ^ dice) +
                                    static_cast<std::uint64_t>(getpid()));
  const auto number = static_cast<std::int32_t>(bits >> 33);  // a positive one, for who prints it
  return number == 0 ? 1 : number;
}

std::int32_t calibration_id(std::string_view canonical) {
  std::uint32_t hash = 2'166'136'261U;
  for (const char c : canonical) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 16'777'619U;
  }
  return static_cast<std::int32_t>(hash & 0x7FFF'FFFFU);
}

drivers::LinkIdentity link_identity(const core::SessionSettings& session) {
  drivers::LinkIdentity identity;
  identity.product_version = version_number(program_version());
  identity.boot = draw_boot_number();
  identity.camera_id = calibration_id(drivers::camera_text(session.camera));
  identity.tool_id = calibration_id(drivers::tool_text(session.tool));
  identity.window_px = session.start.window_px;
  identity.optimum_px = session.start.optimum_px;
  return identity;
}

}  // namespace tubesight::board
