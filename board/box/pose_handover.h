#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "board/box/pose_desk.h"
#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/reply.h"
#include "core/base/spsc_queue.h"

namespace tubesight::board {

/// Carries fields and orders from the tracking thread to another, that computes poses at leisure,
/// and the results back.
///
/// The desk's functions belong to the tracking thread: they copy pixels while a pose is wanted, and
/// never wait and never allocate. serve() belongs to the other. A field for which no buffer is free
/// is passed over: the average then takes a later one.
class PoseHandover final : public PoseDesk {
 public:
  /// `desk` computes, on the thread of serve(); it outlives the handover. Width and height are
  /// those of the whole frame.
  PoseHandover(PoseDesk& desk, std::int32_t width_px, std::int32_t height_px);

  void take(const core::Field& field, std::int64_t number, const core::PoseOrder& order) override;
  [[nodiscard]] std::optional<core::Event> take_result() override;

  /// Works on what was handed over, a field at most; says whether there was one. Computes when
  /// there are enough, which takes some tens of milliseconds.
  bool serve();

  /// Fields passed over so far because the other thread was busy. Any thread.
  [[nodiscard]] std::int64_t passed_over() const { return passed_over_.load(); }

 private:
  /// The other thread is behind by a computation at most, and then no field is wanted any more.
  static constexpr std::uint32_t kSlots = 4;

  struct Slot {
    std::vector<std::uint8_t> pixels;
    core::Field field;
    std::int64_t number = 0;
    core::PoseOrder order;
  };

  void copy_pixels(const core::Field& field, Slot& slot) const;

  PoseDesk* desk_;
  std::array<Slot, kSlots> slots_;
  core::SpscQueue<std::uint32_t, kSlots> free_;
  core::SpscQueue<std::uint32_t, kSlots> filled_;
  core::SpscQueue<core::Event, 2> results_;
  // Of the tracking thread.
  std::optional<core::PoseOrder> order_;  ///< not handed over yet
  bool wanted_ = false;                   ///< from an order to its result
  std::atomic<std::int64_t> passed_over_{0};
};

}  // namespace tubesight::board
