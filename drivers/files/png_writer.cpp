#include "drivers/files/png_writer.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include <png.h>
#include <zlib.h>

#include "drivers/files/atomic_file.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

/// The colours of a picture that has few: pictures of a grey camera with marks in a dozen colours.
/// A byte a pixel is written in a third of the time of three.
class Palette {
 public:
  /// Reads the picture's colours and what each pixel has; false when they are too many. Greys come
  /// first and in order, so that numbers of neighbours differ as little as they do.
  [[nodiscard]] bool read(const core::RgbImageView& rgb, PngGreys what) {
    Counts greys{};
    if (!collect(rgb, greys)) {
      return false;
    }
    std::array<bool, kMost> left_out{};
    if (what == PngGreys::kNear) {
      leave_out_rarest(greys, left_out);
    }
    std::array<std::uint8_t, kMost> number_of_grey{};
    std::vector<png_color> entries;
    for (std::size_t grey = 0; grey < kMost; ++grey) {
      if (greys[grey] > 0 && !left_out[grey]) {
        number_of_grey[grey] = static_cast<std::uint8_t>(entries.size());
        const auto value = static_cast<png_byte>(grey);
        entries.push_back({value, value, value});
      }
    }
    for (std::size_t grey = 0; grey < kMost; ++grey) {
      if (left_out[grey]) {
        number_of_grey[grey] = number_of_grey[neighbour_of(grey, greys, left_out)];
      }
    }
    first_colour_ = entries.size();
    entries.insert(entries.end(), entries_.begin(), entries_.end());
    if (entries.size() > kMost) {
      return false;
    }
    number(rgb, number_of_grey);
    entries_ = entries;
    return true;
  }

  [[nodiscard]] std::span<const png_color> entries() const { return entries_; }
  [[nodiscard]] const std::uint8_t* numbers() const { return numbers_.data(); }

 private:
  static constexpr std::size_t kMost = 256;
  static constexpr std::int32_t kChannels = 3;
  using Counts = std::array<std::int32_t, kMost>;  ///< of pixels, by grey

  static bool is_grey(const std::uint8_t* pixel) {
    return pixel[0] == pixel[1] && pixel[1] == pixel[2];
  }

  /// The greys that there are, and the colours in the order in which they appear.
  bool collect(const core::RgbImageView& rgb, Counts& greys) {
    entries_.clear();
    for (std::int32_t line = 0; line < rgb.height_px; ++line) {
      const std::uint8_t* pixel = rgb.pixels + std::ptrdiff_t{line} * rgb.stride_bytes;
      for (std::int32_t u = 0; u < rgb.width_px; ++u, pixel += kChannels) {
        if (is_grey(pixel)) {
          ++greys[pixel[0]];
        } else if (find(pixel) == entries_.size()) {
          if (entries_.size() == kMost) {
            return false;
          }
          entries_.push_back({pixel[0], pixel[1], pixel[2]});
        }
      }
    }
    return true;
  }

  /// The grey that stands for one that is left out: that one level away which stays, or `kMost`.
  static std::size_t neighbour_of(std::size_t grey, const Counts& greys,
                                  const std::array<bool, kMost>& left_out) {
    for (const std::size_t near : {grey + 1, grey - 1}) {  // 0 - 1 is no grey
      if (near < kMost && greys[near] > 0 && !left_out[near]) {
        return near;
      }
    }
    return kMost;
  }

  /// Leaves out as many greys as are too many beside the colours, the rarest first, each with a
  /// neighbour that stays.
  void leave_out_rarest(const Counts& greys, std::array<bool, kMost>& left_out) const {
    std::vector<std::size_t> rarest;
    for (std::size_t grey = 0; grey < kMost; ++grey) {
      if (greys[grey] > 0) {
        rarest.push_back(grey);
      }
    }
    std::size_t colours = rarest.size() + entries_.size();
    std::stable_sort(rarest.begin(), rarest.end(),
                     [&](std::size_t a, std::size_t b) { return greys[a] < greys[b]; });
    std::array<bool, kMost> stands_for_another{};
    for (const std::size_t grey : rarest) {
      const std::size_t near =
          stands_for_another[grey] ? kMost : neighbour_of(grey, greys, left_out);
      if (colours > kMost && near < kMost) {
        left_out[grey] = true;
        stands_for_another[near] = true;
        --colours;
      }
    }
  }

  void number(const core::RgbImageView& rgb, const std::array<std::uint8_t, kMost>& of_grey) {
    numbers_.clear();
    numbers_.reserve(static_cast<std::size_t>(rgb.width_px) *
                     static_cast<std::size_t>(rgb.height_px));
    for (std::int32_t line = 0; line < rgb.height_px; ++line) {
      const std::uint8_t* pixel = rgb.pixels + std::ptrdiff_t{line} * rgb.stride_bytes;
      for (std::int32_t u = 0; u < rgb.width_px; ++u, pixel += kChannels) {
        numbers_.push_back(is_grey(pixel) ? of_grey[pixel[0]]
                                          : static_cast<std::uint8_t>(first_colour_ + find(pixel)));
      }
    }
  }

  /// Among the colours; their number when it is none. Neighbours have one colour: it is looked at
  /// first.
  std::size_t find(const std::uint8_t* pixel) {
    const auto same = [pixel](const png_color& entry) {
      return entry.red == pixel[0] && entry.green == pixel[1] && entry.blue == pixel[2];
    };
    if (found_ < entries_.size() && same(entries_[found_])) {
      return found_;
    }
    const auto place = std::find_if(entries_.begin(), entries_.end(), same);
    found_ = static_cast<std::size_t>(place - entries_.begin());
    return found_;
  }

  std::vector<png_color> entries_;
  std::size_t first_colour_ = 0;
  std::size_t found_ = 0;
  std::vector<std::uint8_t> numbers_;
};

/// What is written, and what libpng's callbacks need. libpng reports errors by longjmp, so nothing
/// with a destructor may live between setjmp and the calls.
struct PngOutput {
  int colour_type = PNG_COLOR_TYPE_GRAY;
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  const std::uint8_t* pixels = nullptr;
  std::int32_t stride_bytes = 0;
  std::span<const png_color> palette;
  std::vector<std::byte> bytes;
  std::array<char, 80> error{};
};

void note_error(png_structp png, png_const_charp text) {
  auto* const output = static_cast<PngOutput*>(png_get_error_ptr(png));
  std::strncpy(output->error.data(), text, output->error.size() - 1);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

void take_bytes(png_structp png, png_bytep bytes, std::size_t count) {
  auto& output = *static_cast<PngOutput*>(png_get_io_ptr(png));
  const auto* const first = reinterpret_cast<const std::byte*>(bytes);
  output.bytes.insert(output.bytes.end(), first, first + count);
}

/// Differences of neighbours, their bytes coded by frequency and runs: of noisy pictures that is
/// smaller than what looks for repeated strings, and takes a fifth of the time.
bool encode(png_structp png, png_infop info, PngOutput& output) {
  constexpr int kBits = 8;
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  png_set_write_fn(png, &output, take_bytes, nullptr);
  png_set_compression_level(png, Z_BEST_SPEED);
  png_set_compression_strategy(png, Z_RLE);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_IHDR(png, info, static_cast<png_uint_32>(output.width_px),
               static_cast<png_uint_32>(output.height_px), kBits, output.colour_type,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!output.palette.empty()) {
    png_set_PLTE(png, info, output.palette.data(), static_cast<int>(output.palette.size()));
  }
  png_write_info(png, info);
  for (std::int32_t line = 0; line < output.height_px; ++line) {
    png_write_row(png, output.pixels + std::ptrdiff_t{line} * output.stride_bytes);
  }
  png_write_end(png, nullptr);
  return true;
}

Result<void> write(const std::string& path, PngOutput& output, std::string& message) {
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &output, note_error, ignore_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  const bool good = info != nullptr && encode(png, info, output);
  png_destroy_write_struct(&png, &info);
  if (!good) {
    message = path + ": cannot be written as PNG: " +
              (output.error[0] == 0 ? "no memory" : output.error.data());
    return Unexpected(Error::kIo);
  }
  AtomicFile file;
  auto outcome = file.open(path);
  if (outcome) {
    outcome = file.write(std::span<const std::byte>(output.bytes));
  }
  if (outcome) {
    outcome = file.commit();
  }
  if (!outcome) {
    message = file.message();
  }
  return outcome;
}

}  // namespace

Result<void> write_png(const std::string& path, const core::ImageView& grey, std::string& message) {
  PngOutput output;
  output.width_px = grey.width_px;
  output.height_px = grey.height_px;
  output.pixels = grey.pixels;
  output.stride_bytes = grey.stride_px;
  return write(path, output, message);
}

Result<void> write_png(const std::string& path, const core::RgbImageView& rgb, std::string& message,
                       PngGreys greys) {
  PngOutput output;
  output.width_px = rgb.width_px;
  output.height_px = rgb.height_px;
  Palette palette;
  if (palette.read(rgb, greys)) {
    output.colour_type = PNG_COLOR_TYPE_PALETTE;
    output.palette = palette.entries();
    output.pixels = palette.numbers();
    output.stride_bytes = rgb.width_px;
  } else {
    output.colour_type = PNG_COLOR_TYPE_RGB;
    output.pixels = rgb.pixels;
    output.stride_bytes = rgb.stride_bytes;
  }
  return write(path, output, message);
}

}  // namespace tubesight::drivers
