#include "drivers/files/y4m_writer.h"

#include <algorithm>
#include <span>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::string_view kFrame = "FRAME\n";

/// ITU-R BT.601 from full-range RGB to limited range, in 1/65536: 65.481, 128.553, 24.966 (luma)
/// and 37.797, 74.203, 112, 93.786, 18.214 (chroma) over 255. Grey gives chroma 128 exactly, as
/// each chroma row sums to zero.
struct Ycc {
  std::uint8_t y, cb, cr;
};

Ycc to_ycc(std::int32_t r, std::int32_t g, std::int32_t b) {
  constexpr std::int32_t kHalf = 1 << 15;
  constexpr std::int32_t kCentre = 128 << 16;
  const std::int32_t y = (16 << 16) + 16829 * r + 33039 * g + 6416 * b + kHalf;
  const std::int32_t cb = kCentre - 9714 * r - 19070 * g + 28784 * b + kHalf;
  const std::int32_t cr = kCentre + 28784 * r - 24103 * g - 4681 * b + kHalf;
  return {static_cast<std::uint8_t>(y >> 16), static_cast<std::uint8_t>(cb >> 16),
          static_cast<std::uint8_t>(cr >> 16)};
}

std::string header_line(const Y4mHeader& header, Y4mWriter::Colour colour) {
  std::string line =
      "YUV4MPEG2 W" + std::to_string(header.width_px) + " H" + std::to_string(header.height_px);
  if (header.rate_numerator > 0) {
    line += " F" + std::to_string(header.rate_numerator) + ":" +
            std::to_string(header.rate_denominator);
  }
  switch (header.interlacing) {
    case Y4mInterlacing::kUnstated: break;
    case Y4mInterlacing::kProgressive: line += " Ip"; break;
    case Y4mInterlacing::kEvenFirst: line += " It"; break;
    case Y4mInterlacing::kOddFirst: line += " Ib"; break;
  }
  return line + (colour == Y4mWriter::Colour::kMono ? " Cmono\n" : " C444\n");
}

}  // namespace

Result<void> Y4mWriter::open(const std::string& path, const Y4mHeader& header, Colour colour) {
  if (header.width_px < 1 || header.height_px < 1) {
    return Unexpected(Error::kInvalidArgument);
  }
  header_ = header;
  colour_ = colour;
  planes_.resize(static_cast<std::size_t>(header.luma_bytes()) * (colour == Colour::k444 ? 3 : 1));
  TUBESIGHT_TRY(file_.open(path));
  return file_.write(header_line(header, colour));
}

Result<void> Y4mWriter::write_frame(const core::ImageView& grey) {
  if (!file_.is_open()) {
    return Unexpected(Error::kNotReady);
  }
  if (colour_ != Colour::kMono || grey.width_px != header_.width_px ||
      grey.height_px != header_.height_px) {
    return Unexpected(Error::kInvalidArgument);
  }
  auto* out = planes_.data();
  for (std::int32_t v = 0; v < grey.height_px; ++v) {
    out = std::copy_n(grey.line(v), grey.width_px, out);
  }
  TUBESIGHT_TRY(file_.write(kFrame));
  return file_.write(std::as_bytes(std::span(planes_)));
}

Result<void> Y4mWriter::write_frame(const core::RgbImageView& rgb) {
  if (!file_.is_open()) {
    return Unexpected(Error::kNotReady);
  }
  if (colour_ != Colour::k444 || rgb.width_px != header_.width_px ||
      rgb.height_px != header_.height_px) {
    return Unexpected(Error::kInvalidArgument);
  }
  const auto plane = static_cast<std::size_t>(header_.luma_bytes());
  std::size_t i = 0;
  for (std::int32_t v = 0; v < rgb.height_px; ++v) {
    const std::uint8_t* pixel = rgb.pixels + static_cast<std::ptrdiff_t>(v) * rgb.stride_bytes;
    for (std::int32_t u = 0; u < rgb.width_px; ++u, pixel += 3, ++i) {
      const Ycc ycc = to_ycc(pixel[0], pixel[1], pixel[2]);
      planes_[i] = ycc.y;
      planes_[plane + i] = ycc.cb;
      planes_[2 * plane + i] = ycc.cr;
    }
  }
  TUBESIGHT_TRY(file_.write(kFrame));
  return file_.write(std::as_bytes(std::span(planes_)));
}

}  // namespace tubesight::drivers
