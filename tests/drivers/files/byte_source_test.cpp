#include "drivers/files/byte_source.h"

#include <cstdint>

#include <gtest/gtest.h>

#include "tests/support/recording_text.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

/// Reads to the end or the first error; `chunk` bytes at a time.
core::Result<void> read_all(ByteSource& source, std::size_t chunk, std::string& text) {
  std::string buffer(chunk, '\0');
  while (true) {
    const auto count = source.read(std::as_writable_bytes(std::span(buffer)));
    if (!count) {
      return core::Unexpected(count.error());
    }
    if (*count == 0) {
      return {};
    }
    text.append(buffer, 0, *count);
  }
}

/// Noise, which does not compress: a cut in the middle leaves half of it.
std::string long_text() {
  std::string text;
  std::uint32_t noise = 1;
  for (int i = 0; i < 200000; ++i) {
    noise = noise * 1664525u + 1013904223u;
    text += static_cast<char>(noise >> 24);
  }
  return text;
}

TEST(DecompressIfXz, LeavesOtherBytesAsTheyAre) {
  for (const std::string& text : {std::string("YUV4MPEG2 W1"), std::string("ab"), std::string()}) {
    auto source = support::source_of(text);
    std::string message;
    std::string read;

    ASSERT_TRUE(decompress_if_xz(source, message));
    ASSERT_TRUE(read_all(*source, 3, read));

    EXPECT_EQ(read, text);
  }
}

TEST(DecompressIfXz, GivesBackWhatWasCompressed) {
  const std::string text = long_text();
  const std::string compressed = support::compress_xz(text);
  for (const std::size_t chunk : {std::size_t{7}, std::size_t{65536}, std::size_t{1000000}}) {
    auto source = support::source_of(compressed);
    std::string message;
    std::string read;

    ASSERT_TRUE(decompress_if_xz(source, message));
    ASSERT_TRUE(read_all(*source, chunk, read));

    EXPECT_TRUE(read == text) << "chunk " << chunk;
  }
}

TEST(DecompressIfXz, ReadsConcatenatedStreams) {
  const std::string compressed = support::compress_xz("first ") + support::compress_xz("second");
  auto source = support::source_of(compressed);
  std::string message;
  std::string read;

  ASSERT_TRUE(decompress_if_xz(source, message));
  ASSERT_TRUE(read_all(*source, 100, read));

  EXPECT_EQ(read, "first second");
}

TEST(DecompressIfXz, TellsDataThatEndsEarly) {
  std::string compressed = support::compress_xz(long_text());
  compressed.resize(compressed.size() / 2);
  auto source = support::source_of(compressed);
  std::string message;
  std::string read;
  ASSERT_TRUE(decompress_if_xz(source, message));

  const auto outcome = read_all(*source, 1000, read);

  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error(), core::Error::kDataLoss);
  EXPECT_EQ(source->message(), "the compressed data ends early");
  EXPECT_EQ(read, long_text().substr(0, read.size()));
  EXPECT_GT(read.size(), 1000u);
}

TEST(DecompressIfXz, TellsCorruptData) {
  std::string compressed = support::compress_xz(long_text());
  compressed[compressed.size() / 2] = static_cast<char>(compressed[compressed.size() / 2] ^ 0x10);
  auto source = support::source_of(compressed);
  std::string message;
  std::string read;
  ASSERT_TRUE(decompress_if_xz(source, message));

  const auto outcome = read_all(*source, 1000, read);

  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error(), core::Error::kIo);
  EXPECT_EQ(source->message(), "the xz data is corrupt");
}

TEST(ReadWholeFile, ReadsUpToItsLimit) {
  const support::TemporaryFolder folder;
  const std::string path = folder.write("a", "12345");
  std::string text;
  std::string message;

  EXPECT_TRUE(read_whole_file(path, 5, text, message));
  EXPECT_EQ(text, "12345");
  EXPECT_EQ(read_whole_file(path, 4, text, message).error(), core::Error::kOutOfRange);
  EXPECT_EQ(message, "longer than 4 bytes");
}

TEST(ReadWholeFile, TellsWhyItCannot) {
  const support::TemporaryFolder folder;
  std::string text;
  std::string message;

  EXPECT_EQ(read_whole_file(folder.path("none"), 9, text, message).error(), core::Error::kIo);
  EXPECT_EQ(message, "No such file or directory");
  EXPECT_EQ(read_whole_file(folder.path(""), 9, text, message).error(), core::Error::kIo);
  EXPECT_EQ(message, "Is a directory");
}

}  // namespace
}  // namespace tubesight::drivers
