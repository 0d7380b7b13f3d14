#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "board/box/frame_view.h"
#include "board/box/picture_tap.h"
#include "board/visionbox/page_picture.h"
#include "board/visionbox/source_clock.h"
#include "drivers/web/page_server.h"

namespace tubesight::board {

/// Pictures for whoever looks: takes fields from the tap while somebody does, makes whole pictures
/// of them, and hands each viewer the next one when he asks.
///
/// A JPEG is made once for a field and a quality however many look, and none when nobody does: a
/// slow viewer gets fewer pictures, never old ones.
class PictureHub {
 public:
  using Picture = std::shared_ptr<const PagePicture>;
  /// What a viewer who waited is told; null: no picture came in time.
  using Deliver = std::function<void(const Picture&)>;

  static constexpr std::size_t kMostWaiting = 64;
  static constexpr MonotonicTime kPatience = std::chrono::seconds(2);

  /// `tap` outlives the hub.
  PictureHub(PictureTap& tap, std::int32_t width_px, std::int32_t height_px)
      : tap_(&tap), view_(width_px, height_px) {}

  /// The next picture with a field's number beyond `after`, by `deliver` on the thread of serve();
  /// false: too many wait. Any thread.
  [[nodiscard]] bool ask(std::int64_t after, MonotonicTime now, Deliver deliver);
  /// Lets tubes be shown where they are expected, for a while. Any thread.
  void want_estimates(MonotonicTime now);

  /// Takes what came, and serves who waits; says whether somebody looks. One thread.
  bool serve(MonotonicTime now);

  /// The latest picture; null: none came yet. Any thread.
  [[nodiscard]] Picture latest() const;

 private:
  /// Fields are taken for so long after the last question.
  static constexpr MonotonicTime kLooked = std::chrono::seconds(3);

  struct Waiting {
    std::int64_t after = 0;
    MonotonicTime until{0};
    Deliver deliver;
  };

  void take_fields();

  PictureTap* tap_;
  FrameView view_;
  mutable std::mutex mutex_;
  Picture latest_;
  MonotonicTime looked_at_{-kLooked};
  MonotonicTime estimates_at_{-kLooked};
  std::vector<Waiting> waiting_;
};

}  // namespace tubesight::board
