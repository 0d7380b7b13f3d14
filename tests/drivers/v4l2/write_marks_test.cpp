// Buffers that a driver hands out without having written them, or not all of their lines: what
// stands there is of some buffers ago, and no flag says so.

#include "drivers/v4l2/write_marks.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/drivers/v4l2/camera_bench.h"

namespace tubesight::tests {
namespace {

using core::FieldStatus;
using core::Scan;
using drivers::CameraTrouble;

/// How a camera delivers: format, order of the fields, and lines of a buffer.
struct Delivery {
  std::string name;
  std::uint32_t format;
  std::uint32_t field;
  Scan scan;
};

class UnwrittenLines : public testing::TestWithParam<Delivery> {
 protected:
  void SetUp() override {
    bench_.camera().formats = {GetParam().format};
    bench_.camera().fields = {GetParam().field};
    bench_.camera().padding_bytes = 6;
    ASSERT_TRUE(bench_.grabber().start()) << bench_.message();
    for (int i = 0; i < 12; ++i) {
      ASSERT_EQ(next_buffer(), good()) << "each buffer was written once";
    }
  }

  [[nodiscard]] std::vector<FieldStatus> good() const {
    return std::vector<FieldStatus>(static_cast<std::size_t>(bench_.grabber().fields_a_buffer()),
                                    FieldStatus::kGood);
  }
  std::vector<FieldStatus> next_buffer() {
    std::vector<FieldStatus> status;
    for (std::int32_t i = 0; i < bench_.grabber().fields_a_buffer(); ++i) {
      status.push_back(bench_.next_status());
    }
    return status;
  }
  [[nodiscard]] std::uint32_t lines() const {
    return GetParam().field == V4L2_FIELD_ALTERNATE ? 24 : 48;
  }

  mutable CameraBench bench_{settings_of(GetParam().scan)};
};

TEST_P(UnwrittenLines, APictureThatWasNotWrittenIsDamaged) {
  bench_.camera().unwritten = {{0, lines()}};

  EXPECT_EQ(std::ranges::count(next_buffer(), FieldStatus::kGood), 0);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kDamaged);
  EXPECT_EQ(bench_.counters().unwritten, bench_.grabber().fields_a_buffer());

  EXPECT_EQ(next_buffer(), good());
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kNone);
}

// A packet of a grabber is of two lines; wherever it gets lost.
TEST_P(UnwrittenLines, TwoLinesThatWereNotWrittenAreFoundWhereverTheyStand) {
  for (std::uint32_t line = 0; line + 1 < lines(); ++line) {
    bench_.camera().unwritten = {{line, line + 2}};
    EXPECT_NE(next_buffer(), good()) << line;
    EXPECT_EQ(next_buffer(), good()) << line;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Orders, UnwrittenLines,
    testing::Values(
        Delivery{"Grey", V4L2_PIX_FMT_GREY, V4L2_FIELD_NONE, Scan::kProgressive},
        Delivery{"GreyInterlaced", V4L2_PIX_FMT_GREY, V4L2_FIELD_INTERLACED, Scan::kOddFirst},
        Delivery{"YuyvSequential", V4L2_PIX_FMT_YUYV, V4L2_FIELD_SEQ_BT, Scan::kOddFirst},
        Delivery{"UyvyInterlaced", V4L2_PIX_FMT_UYVY, V4L2_FIELD_INTERLACED, Scan::kEvenFirst},
        Delivery{"Y10", V4L2_PIX_FMT_Y10, V4L2_FIELD_NONE, Scan::kProgressive},
        Delivery{"GreyAlternate", V4L2_PIX_FMT_GREY, V4L2_FIELD_ALTERNATE, Scan::kEvenFirst}),
    [](const auto& each) { return each.param.name; });

// One of two fields: the other is as good as ever.
TEST(UnwrittenField, DamagesThatFieldAlone) {
  CameraBench bench(settings_of(Scan::kEvenFirst));
  bench.camera().fields = {V4L2_FIELD_SEQ_TB};
  ASSERT_TRUE(bench.grabber().start());
  bench.camera().unwritten = {{24, 48}};

  EXPECT_EQ(bench.next_status(), FieldStatus::kGood);
  EXPECT_EQ(bench.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench.counters().unwritten, 1);
}

// Half lines above and below, and columns without video, stay as they are for good.
TEST(WriteMarks, LeaveTheEdgesOfAPictureAlone) {
  drivers::v4l2::AgreedFormat agreed;
  agreed.pixel = *drivers::v4l2::pixel_format_named("GREY");
  agreed.kind = drivers::v4l2::BufferKind::kPair;
  agreed.lines = 480;
  agreed.stride_bytes = 720;
  drivers::v4l2::WriteMarks marks;
  marks.begin(agreed, 720);
  std::vector<std::byte> picture(480 * 720);
  marks.lay(picture.data());
  for (std::size_t v = 8; v < 472; ++v) {
    std::fill_n(picture.begin() + static_cast<std::ptrdiff_t>(v * 720 + 12), 720 - 24,
                std::byte{100});
  }

  EXPECT_FALSE(marks.left(picture.data(), agreed.lines_of(false, false)));
  EXPECT_FALSE(marks.left(picture.data(), agreed.lines_of(true, false)));
}

// A dark grey of 10 bits, and white of a sensor of 8 bits in the upper half of 16, among others.
TEST(WriteMarks, AreNoPictureOfOneGrey) {
  for (const char* const name : {"Y10", "Y16"}) {
    drivers::v4l2::AgreedFormat agreed;
    agreed.pixel = *drivers::v4l2::pixel_format_named(name);
    agreed.lines = 48;
    agreed.stride_bytes = 128;
    drivers::v4l2::WriteMarks marks;
    marks.begin(agreed, 64);
    for (const unsigned grey : {0x0000U, 0x00ffU, 0xff00U, 0xffffU}) {
      std::vector<std::byte> picture(48 * 128);
      for (std::size_t i = 0; i < picture.size(); i += 2) {
        picture[i] = static_cast<std::byte>(grey & 0xffU);
        picture[i + 1] = static_cast<std::byte>(grey >> 8U);
      }
      EXPECT_FALSE(marks.left(picture.data(), agreed.lines_of(false, false))) << name << grey;
    }
  }
}

// What the driver flags is counted as that alone.
TEST(UnwrittenField, OfAFlaggedBufferIsToldOnce) {
  CameraBench bench;
  ASSERT_TRUE(bench.grabber().start());
  bench.camera().unwritten = {{0, 48}};
  bench.camera().tamper = [](auto, v4l2_buffer& buffer, auto) {
    buffer.flags |= V4L2_BUF_FLAG_ERROR;
  };

  EXPECT_EQ(bench.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench.counters().flagged, 1);
  EXPECT_EQ(bench.counters().unwritten, 0);
}

// Of a large picture every so many lines: what it costs stays that of a small one.
TEST(WriteMarks, AreAsManyInALargePictureAsInASmallOne) {
  drivers::v4l2::AgreedFormat agreed;
  agreed.pixel = *drivers::v4l2::pixel_format_named("GREY");
  agreed.lines = 1200;
  agreed.stride_bytes = 1920;
  drivers::v4l2::WriteMarks marks;
  marks.begin(agreed, 1920);
  std::vector<std::byte> picture(1200 * 1920, std::byte{100});
  marks.lay(picture.data());

  EXPECT_EQ(std::ranges::count_if(picture, [](std::byte grey) { return grey != std::byte{100}; }),
            115 * 8)
      << "of 120 lines those that are not at the edges";
  EXPECT_TRUE(marks.left(picture.data(), agreed.lines_of(false, false)));
}

}  // namespace
}  // namespace tubesight::tests
