#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/image_view.h"
#include "core/base/result.h"
#include "drivers/files/atomic_file.h"
#include "drivers/files/y4m_header.h"

namespace tubesight::drivers {

/// Writes a YUV4MPEG2 video that appears under its name only when finished.
class Y4mWriter {
 public:
  enum class Colour : std::uint8_t {
    kMono,  ///< `Cmono`: grey values as they are
    k444,   ///< `C444`: ITU-R BT.601 in limited range (16..235), what players expect
  };

  /// Begins `path`. Of `header` the size, the rate (left out when its numerator is 0) and the
  /// interlacing are written. Errors: kIo, kInvalidArgument no pixels.
  [[nodiscard]] core::Result<void> open(const std::string& path, const Y4mHeader& header,
                                        Colour colour);

  /// Appends one frame of the header's size. Errors: kIo (the disk is full, say), kNotReady not
  /// open, kInvalidArgument another size or another kind of picture than open() was told.
  [[nodiscard]] core::Result<void> write_frame(const core::ImageView& grey);
  [[nodiscard]] core::Result<void> write_frame(const core::RgbImageView& rgb);

  /// As AtomicFile::flush().
  [[nodiscard]] core::Result<void> flush() { return file_.flush(); }

  /// As AtomicFile::sync().
  [[nodiscard]] core::Result<void> sync() { return file_.sync(); }

  /// Finishes the file. Errors: kIo, kNotReady.
  [[nodiscard]] core::Result<void> commit() { return file_.commit(); }

  /// The last failure in one line, with the file's name.
  [[nodiscard]] const std::string& message() const { return file_.message(); }

 private:
  AtomicFile file_;
  Y4mHeader header_;
  Colour colour_ = Colour::kMono;
  std::vector<std::uint8_t> planes_;
};

}  // namespace tubesight::drivers
