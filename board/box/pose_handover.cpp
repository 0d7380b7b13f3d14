#include "board/box/pose_handover.h"

#include <cstddef>

#include "core/base/assert.h"
#include "core/base/copy_lines.h"

namespace tubesight::board {

PoseHandover::PoseHandover(PoseDesk& desk, std::int32_t width_px, std::int32_t height_px)
    : desk_(&desk) {
  for (std::uint32_t i = 0; i < kSlots; ++i) {
    slots_[i].pixels.resize(static_cast<std::size_t>(width_px) *
                            static_cast<std::size_t>(height_px));
    static_cast<void>(free_.try_push(i));  // there is room for all
  }
}

void PoseHandover::take(const core::Field& field, std::int64_t number,
                        const core::PoseOrder& order) {
  if (order.wanted) {
    order_ = order;
    wanted_ = true;
  }
  if (!wanted_ || field.status != core::FieldStatus::kGood) {
    return;
  }
  std::uint32_t index = 0;
  if (!free_.try_pop(index)) {
    ++passed_over_;
    return;
  }
  Slot& slot = slots_[index];
  copy_pixels(field, slot);
  slot.number = number;
  slot.order = order_.value_or(core::PoseOrder{});
  order_.reset();
  static_cast<void>(filled_.try_push(index));  // as many places as slots
}

/// The field's own lines, closed up: where they stand in the frame is in the view's other members.
void PoseHandover::copy_pixels(const core::Field& field, Slot& slot) const {
  const core::FieldView& from = field.pixels;
  TUBESIGHT_ASSERT(static_cast<std::size_t>(from.width_px) * static_cast<std::size_t>(from.lines) <=
                   slot.pixels.size());
  slot.field = field;
  slot.field.pixels = core::copied_lines(from, slot.pixels.data());
}

std::optional<core::Event> PoseHandover::take_result() {
  core::Event result;
  if (!results_.try_pop(result)) {
    return {};
  }
  // What was handed over beyond the need is passed over by the other thread.
  wanted_ = order_.has_value();
  return result;
}

bool PoseHandover::serve() {
  std::uint32_t index = 0;
  if (!filled_.try_pop(index)) {
    return false;
  }
  Slot& slot = slots_[index];
  desk_->take(slot.field, slot.number, slot.order);
  static_cast<void>(free_.try_push(index));  // as many places as slots
  if (const auto result = desk_->take_result()) {
    // A request is refused while the one before has no result: more than one never waits.
    const bool room = results_.try_push(*result);
    TUBESIGHT_ASSERT(room);
  }
  return true;
}

}  // namespace tubesight::board
