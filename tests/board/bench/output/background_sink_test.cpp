#include "board/bench/output/background_sink.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

/// What a sink was given, kept by the test.
struct Given {
  std::vector<std::int64_t> fields;
  std::vector<std::uint8_t> first_bytes;
  bool committed = false;
  bool gone = false;
};

/// A sink that takes its time, and fails at one field.
class SlowSink final : public OverlaySink {
 public:
  SlowSink(Given& given, std::int64_t fails_at) : given_(&given), fails_at_(fails_at) {}
  ~SlowSink() override { given_->gone = true; }

  core::Result<void> open(const drivers::Y4mHeader&, bool) override { return {}; }
  core::Result<void> add(std::int64_t field, const core::RgbImageView& picture) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (field == fails_at_) {
      message_ = "the disk is full";
      return core::Unexpected(core::Error::kIo);
    }
    given_->fields.push_back(field);
    given_->first_bytes.push_back(picture.pixels[picture.stride_bytes]);  // of the second line
    return {};
  }
  core::Result<void> commit() override {
    given_->committed = true;
    return {};
  }
  const std::string& message() const override { return message_; }

 private:
  Given* given_;
  std::int64_t fails_at_;
  std::string message_;
};

/// A picture of 2 x 2 in a buffer that is used again for the next, with a stride of its own.
class Picture {
 public:
  core::RgbImageView of(std::uint8_t value) {
    pixels_.assign(20, 0);
    pixels_[10] = value;
    return {pixels_.data(), 2, 2, 10};
  }

 private:
  std::vector<std::uint8_t> pixels_;
};

TEST(BackgroundSink, HandsAllOnInOrderBeforeItCommits) {
  Given given;
  BackgroundSink sink(std::make_unique<SlowSink>(given, -1));
  Picture picture;
  ASSERT_TRUE(sink.open({}, false));

  for (int field = 0; field < 20; ++field) {
    ASSERT_TRUE(sink.add(field, picture.of(static_cast<std::uint8_t>(100 + field))));
  }
  ASSERT_TRUE(sink.commit());

  ASSERT_EQ(given.fields.size(), 20U);
  for (int field = 0; field < 20; ++field) {
    EXPECT_EQ(given.fields[static_cast<std::size_t>(field)], field);
    EXPECT_EQ(given.first_bytes[static_cast<std::size_t>(field)], 100 + field);
  }
  EXPECT_TRUE(given.committed);
}

TEST(BackgroundSink, TellsAFailureByTheNextCall) {
  Given given;
  BackgroundSink sink(std::make_unique<SlowSink>(given, 2));
  Picture picture;
  ASSERT_TRUE(sink.open({}, false));

  bool failed = false;
  for (int field = 0; field < 100 && !failed; ++field) {
    failed = !sink.add(field, picture.of(0));
  }

  EXPECT_TRUE(failed);
  EXPECT_EQ(sink.message(), "the disk is full");
  EXPECT_FALSE(sink.commit());
  EXPECT_FALSE(given.committed);
  EXPECT_EQ(given.fields.size(), 2U);
}

TEST(BackgroundSink, TellsAFailureOfTheLastByCommit) {
  Given given;
  BackgroundSink sink(std::make_unique<SlowSink>(given, 0));
  Picture picture;
  ASSERT_TRUE(sink.open({}, false));
  ASSERT_TRUE(sink.add(0, picture.of(0)));

  EXPECT_FALSE(sink.commit());
  EXPECT_FALSE(given.committed);
  EXPECT_EQ(sink.message(), "the disk is full");
}

TEST(BackgroundSink, EndsWithoutCommitting) {
  Given given;
  {
    BackgroundSink sink(std::make_unique<SlowSink>(given, -1));
    Picture picture;
    ASSERT_TRUE(sink.open({}, false));
    ASSERT_TRUE(sink.add(0, picture.of(0)));
  }

  EXPECT_TRUE(given.gone);
  EXPECT_FALSE(given.committed);
}

}  // namespace
}  // namespace tubesight::board
