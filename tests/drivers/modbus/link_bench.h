#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/sighting.h"
#include "drivers/modbus/dialogue.h"
#include "drivers/modbus/link_state.h"
#include "drivers/modbus/outbox.h"
#include "drivers/modbus/request_handler.h"

namespace tubesight::tests {

using namespace std::chrono_literals;

/// The instant at which the tests of the link begin.
inline constexpr core::FieldTime kBegin = 1000s;

/// A sighting in which all is known: tube (12, -7) vouched for, seen at kBegin - 20 ms.
inline core::Sighting make_full_sighting() {
  core::Sighting s;
  s.time = kBegin - 20ms;
  s.field = 3600;
  s.status = core::FieldStatus::kGood;
  s.judged = true;
  s.judged_fields = 3500;
  s.state = core::TrackState::kTracking;
  s.reason = core::Reason::kNone;
  s.tracked = 9;
  s.primary_known = true;
  s.primary = {13, -6};
  s.primary_px = {320 * 65536, 190 * 65536 + 32768};  // 320, 190.5
  s.axis_known = true;
  s.axis_px = {300 * 65536, -10 * 65536};
  s.height_um_q8 = 50'000 * 256;  // 50 mm
  s.tool_known = true;
  s.tool = {12, -7};
  s.offset_um_q8 = 500 * 256;  // 0.5 mm, as 0.3 and -0.4
  s.displacement_um_q8 = {300 * 256, -400 * 256};
  s.aligned = true;
  s.velocity_known = true;
  s.velocity_um_s = {1500, -250};
  s.margin_known = true;
  s.margin_permyriad = 123'456;
  s.residual_px_q16 = 6554;  // 0.1 px
  s.liveness = core::Liveness::kProved;
  return s;
}

inline drivers::LinkIdentity make_identity() {
  drivers::LinkIdentity identity;
  identity.product_version = 102;
  identity.boot = 77;
  identity.camera_id = 0x11223344;
  identity.window_px = {40, 40, 595, 330};
  identity.optimum_px = {320.0, 190.0};
  return identity;
}

/// A dialogue and its handler without a line.
class LinkBench {
 public:
  explicit LinkBench(drivers::WordOrder order = drivers::WordOrder::kHighFirst)
      : dialogue(order, state, outbox), handler(dialogue), order_(order) {}

  drivers::LinkState state{.identity = make_identity(),
                           .sighting = make_full_sighting(),
                           .sequence = 5,
                           .health = {},
                           .self_test = {},
                           .journal = {},
                           .counters = {}};
  drivers::EventQueue events;
  drivers::Outbox outbox{events};
  drivers::Dialogue dialogue;
  drivers::RequestHandler handler;
  core::FieldTime now = kBegin;

  /// What the register says at `now`.
  [[nodiscard]] std::int32_t get(drivers::Register name) {
    const drivers::RegisterRow& row = drivers::row_of(name);
    std::vector<std::uint16_t> words(row.width);
    dialogue.read(row.address, now, words);
    drivers::RegisterImage image(order_);
    for (std::size_t i = 0; i < words.size(); ++i) {
      image.set_word(row.address + static_cast<std::int32_t>(i), words[i]);
    }
    return image.get(name);
  }

  /// Writes one value at `now`.
  [[nodiscard]] drivers::Refusal set(drivers::Register name, std::int64_t value) {
    const drivers::RegisterRow& row = drivers::row_of(name);
    drivers::RegisterImage image(order_);
    image.set(name, value);
    std::vector<std::uint16_t> words;
    for (std::int32_t i = 0; i < row.width; ++i) {
      words.push_back(image.word(row.address + i));
    }
    return dialogue.write(row.address, words, now);
  }

  /// The event that waits longest; one of id 0 when there is none.
  [[nodiscard]] core::Event take_event() {
    core::Event event;
    static_cast<void>(events.try_pop(event));
    return event;
  }

  template <typename Content>
  void reply(std::int64_t id, const Content& content) {
    core::Reply told;
    told.id = id;
    told.at = now;
    told.content = content;
    dialogue.hear(told, now);
  }

 private:
  drivers::WordOrder order_;
};

}  // namespace tubesight::tests
