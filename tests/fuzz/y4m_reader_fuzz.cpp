// Recordings, plain and compressed (told apart by their first bytes): whatever the bytes, the
// reader must end with an error or the end of data, and say why in one line.
#include "drivers/files/y4m_reader.h"

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tubesight;
  drivers::Y4mReader reader;
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto opened = reader.open(std::make_unique<drivers::MemoryByteSource>(bytes), "fuzz.y4m");
  if (!opened) {
    if (reader.message().empty() || reader.message().find('\n') != std::string::npos) {
      std::abort();
    }
    return 0;
  }
  // A frame of 8192 x 8192 is served but would make every run slow.
  constexpr std::int64_t kLargest = 1 << 20;
  if (reader.header().luma_bytes() > kLargest) {
    return 0;
  }
  std::vector<std::uint8_t> luma(static_cast<std::size_t>(reader.header().luma_bytes()));
  constexpr int kMostFrames = 1000;
  for (int frame = 0; frame < kMostFrames; ++frame) {
    const auto read = reader.read_frame(luma);
    if (read) {
      continue;
    }
    if (read.error() != core::Error::kEndOfData && reader.message().empty()) {
      std::abort();
    }
    if (reader.read_frame(luma) || reader.frames_read() != frame) {
      std::abort();  // an error must stay
    }
    break;
  }
  return 0;
}
