#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <lzma.h>

#include "drivers/files/byte_source.h"

namespace tubesight::support {

/// The bytes of a recording: the header line, then frames whose luma byte i of frame f is
/// (base + 10 f + i) mod 256 and whose chroma bytes are 255.
inline std::string recording_text(std::string_view header, int frames, int luma_bytes,
                                  int chroma_bytes = 0, int base = 0) {
  std::string text = std::string(header) + "\n";
  for (int frame = 0; frame < frames; ++frame) {
    text += "FRAME\n";
    for (int i = 0; i < luma_bytes; ++i) {
      text += static_cast<char>((base + 10 * frame + i) % 256);
    }
    text.append(static_cast<std::size_t>(chroma_bytes), '\xFF');
  }
  return text;
}

/// The text compressed as `xz` does it.
inline std::string compress_xz(std::string_view text) {
  std::string result(lzma_stream_buffer_bound(text.size()), '\0');
  std::size_t size = 0;
  const lzma_ret outcome = lzma_easy_buffer_encode(
      6, LZMA_CHECK_CRC64, nullptr, reinterpret_cast<const std::uint8_t*>(text.data()), text.size(),
      reinterpret_cast<std::uint8_t*>(result.data()), &size, result.size());
  EXPECT_EQ(outcome, LZMA_OK);
  result.resize(size);
  return result;
}

/// Bytes of `text`, which the caller keeps, as a source.
inline std::unique_ptr<drivers::ByteSource> source_of(const std::string& text) {
  return std::make_unique<drivers::MemoryByteSource>(std::as_bytes(std::span(text)));
}

}  // namespace tubesight::support
