#pragma once

#include <cstdint>
#include <vector>

#include "core/base/field.h"
#include "core/base/image_view.h"

namespace tubesight::board {

/// The whole picture for display, from the two last fields: each field brings its own lines, the
/// others stay as the field before left them.
///
/// For eyes alone: the lines of a moving tool are a field apart, so nothing is measured in it. What
/// is damaged or missing leaves the picture as it was; that it is old is for the sighting to say.
class FrameView {
 public:
  /// Black until the first field.
  FrameView(std::int32_t width_px, std::int32_t height_px);

  /// Takes the lines of a good field of the size given (asserted). Until a field of the other
  /// parity has come, each line stands for its neighbour, too. Allocates nothing.
  void take(const core::Field& field);

  /// Valid while this object lives; changed by take().
  [[nodiscard]] core::ImageView picture() const {
    return {pixels_.data(), width_px_, height_px_, width_px_};
  }

 private:
  void copy_line(const std::uint8_t* from, std::int32_t to);
  void fill_in_lines(std::int32_t first);

  std::int32_t width_px_;
  std::int32_t height_px_;
  std::vector<std::uint8_t> pixels_;
  bool has_even_ = false;
  bool has_odd_ = false;
};

}  // namespace tubesight::board
