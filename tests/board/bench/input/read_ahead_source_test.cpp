#include "board/bench/input/read_ahead_source.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

/// Counts up, a byte in 251, to its end or failure, in parts of changing size.
class Counting final : public drivers::ByteSource {
 public:
  explicit Counting(std::size_t size, bool fails = false) : size_(size), fails_(fails) {}

  Result<std::size_t> read(std::span<std::byte> into) override {
    if (given_ == size_ && fails_) {
      message_ = "it broke";
      return Unexpected(Error::kDataLoss);
    }
    const std::size_t count = std::min({into.size(), size_ - given_, given_ % 7001 + 1});
    for (std::size_t i = 0; i < count; ++i) {
      into[i] = static_cast<std::byte>((given_ + i) % 251);
    }
    given_ += count;
    return count;
  }
  double share_read() const override {
    return static_cast<double>(given_) / static_cast<double>(size_);
  }
  const std::string& message() const override { return message_; }

 private:
  std::size_t size_;
  bool fails_;
  std::atomic<std::size_t> given_{0};
  std::string message_;
};

/// All that comes, in parts; what the last read said goes to `end`.
std::vector<std::byte> all_of(drivers::ByteSource& source, std::size_t part,
                              Result<std::size_t>& end) {
  std::vector<std::byte> bytes;
  std::vector<std::byte> buffer(part);
  for (end = source.read(buffer); end && *end > 0; end = source.read(buffer)) {
    bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*end));
  }
  return bytes;
}

bool counts_up(const std::vector<std::byte>& bytes) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] != static_cast<std::byte>(i % 251)) {
      return false;
    }
  }
  return true;
}

TEST(ReadAhead, GivesAllInOrderAndThenTheEnd) {
  for (const std::size_t part : {std::size_t{1000}, std::size_t{305'000}, std::size_t{5'000'000}}) {
    constexpr std::size_t kSize = 6'000'003;  // rather more than is held
    ReadAheadSource source(std::make_unique<Counting>(kSize));
    Result<std::size_t> end = std::size_t{0};

    const auto bytes = all_of(source, part, end);

    EXPECT_EQ(bytes.size(), kSize);
    EXPECT_TRUE(counts_up(bytes));
    ASSERT_TRUE(end);
    EXPECT_EQ(source.share_read(), 1.0);
    std::byte more{};
    EXPECT_EQ(*source.read({&more, 1}), 0U);
  }
}

TEST(ReadAhead, TellsAFailureBehindWhatCameBefore) {
  ReadAheadSource source(std::make_unique<Counting>(100'000, true));
  Result<std::size_t> end = std::size_t{0};

  const auto bytes = all_of(source, 4096, end);

  EXPECT_EQ(bytes.size(), 100'000U);
  EXPECT_TRUE(counts_up(bytes));
  ASSERT_FALSE(end);
  EXPECT_EQ(end.error(), Error::kDataLoss);
  EXPECT_EQ(source.message(), "it broke");
}

TEST(ReadAhead, CanBeGivenUpWhileItIsFull) {
  ReadAheadSource source(std::make_unique<Counting>(100'000'000));
  std::vector<std::byte> some(10);
  ASSERT_TRUE(source.read(some));
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_LT(source.share_read(), 0.1);  // no more than its room
}

}  // namespace
}  // namespace tubesight::board
