#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "board/box/overlay_snapshot.h"
#include "core/base/copy_lines.h"
#include "core/base/field.h"

namespace tubesight::board {

/// Fields and their marks on their way from the tracking thread to one that shows them: a few
/// places, into which a field is copied while somebody wants it and a place is free.
///
/// Neither side waits for the other; what finds no place is left out. Nothing is allocated after
/// construction.
class PictureTap {
 public:
  /// A field as it was taken. Its pixels are valid until pop().
  struct Taken {
    core::Field field;
    OverlaySnapshot overlay;
  };

  PictureTap(std::int32_t width_px, std::int32_t height_px) {
    for (Place& place : places_) {
      place.pixels.resize(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
    }
  }

  /// Whether fields are to be taken, and the places where tubes are expected to be in their marks.
  /// Any thread.
  void want(bool fields, bool estimates) {
    wanted_.store(fields, std::memory_order_relaxed);
    estimates_.store(estimates, std::memory_order_relaxed);
  }
  [[nodiscard]] bool wanted() const { return wanted_.load(std::memory_order_relaxed); }
  [[nodiscard]] bool estimates_wanted() const { return estimates_.load(std::memory_order_relaxed); }

  /// Copies a field, of the size given, and its marks, if a place is free; one without pixels that
  /// can be used goes without. The tracking thread.
  void take(const core::Field& field, const OverlaySnapshot& overlay) {
    const std::uint32_t pushed = pushed_.load(std::memory_order_relaxed);
    if (pushed - popped_.load(std::memory_order_acquire) == kPlaces) {
      return;
    }
    Place& place = places_[pushed % kPlaces];
    place.taken.field = field;
    place.taken.overlay = overlay;
    if (field.status == core::FieldStatus::kGood) {
      place.taken.field.pixels = core::copied_lines(field.pixels, place.pixels.data());
    }
    pushed_.store(pushed + 1, std::memory_order_release);
  }

  /// The oldest field that waits; null: none. The showing thread, as pop().
  [[nodiscard]] const Taken* front() const {
    const std::uint32_t popped = popped_.load(std::memory_order_relaxed);
    return pushed_.load(std::memory_order_acquire) == popped ? nullptr
                                                             : &places_[popped % kPlaces].taken;
  }
  /// Frees its place; there is one.
  void pop() { popped_.fetch_add(1, std::memory_order_release); }

 private:
  /// Fields that a thread of ordinary priority may be late: some 60 ms of 60 a second.
  static constexpr std::uint32_t kPlaces = 4;

  struct Place {
    Taken taken;
    std::vector<std::uint8_t> pixels;
  };

  std::array<Place, kPlaces> places_;
  std::atomic<std::uint32_t> pushed_{0};
  std::atomic<std::uint32_t> popped_{0};
  std::atomic<bool> wanted_{false};
  std::atomic<bool> estimates_{false};
};

}  // namespace tubesight::board
