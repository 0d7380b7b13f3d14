#include "drivers/files/frame_line_search.h"

#include <algorithm>
#include <string_view>

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

std::int64_t place_in(std::string_view text, std::size_t part_size) {
  FrameLineSearch search;
  const auto bytes = std::as_bytes(std::span(text));
  for (std::size_t begin = 0; begin < bytes.size(); begin += part_size) {
    search.look_through(bytes.subspan(begin, std::min(part_size, bytes.size() - begin)));
  }
  EXPECT_EQ(search.bytes(), static_cast<std::int64_t>(text.size()));
  return search.found_at();
}

TEST(FrameLineSearch, FindsTheFirstHoweverTheBytesAreCut) {
  for (const std::size_t part_size : {1U, 2U, 3U, 5U, 6U, 7U, 100U}) {
    EXPECT_EQ(place_in("FRAME\nFRAME\n", part_size), 0) << part_size;
    EXPECT_EQ(place_in("FFRFRAFRAMFRAMEFRAME Ip\n", part_size), 15) << part_size;
    EXPECT_EQ(place_in("12345FRAME\n", part_size), 5) << part_size;
  }
}

TEST(FrameLineSearch, WantsTheWholeLine) {
  for (const std::string_view text : {"", "FRAME", "FRAMES\n", "FRAME\r\n", "RAME\n", "frame\n"}) {
    EXPECT_EQ(place_in(text, 3), -1) << text;
  }
}

}  // namespace
}  // namespace tubesight::drivers
