#include "board/bench/output/picture_video.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

drivers::Y4mHeader recording_of(std::int64_t rate, std::int64_t per) {
  drivers::Y4mHeader header;
  header.width_px = 2;
  header.height_px = 1;
  header.rate_numerator = rate;
  header.rate_denominator = per;
  header.interlacing = drivers::Y4mInterlacing::kEvenFirst;
  return header;
}

std::string first_line(const support::TemporaryFolder& folder, const char* name) {
  const std::string text = folder.read(name);
  return text.substr(0, text.find('\n'));
}

TEST(PictureVideo, RunsAtTheRateOfFields) {
  const support::TemporaryFolder folder;
  struct Case {
    std::int64_t rate, per;
    bool interlaced;
    const char* header;
  };
  for (const Case& c : {Case{25, 1, true, "YUV4MPEG2 W2 H1 F50:1 Ip C444"},
                        Case{30000, 1001, true, "YUV4MPEG2 W2 H1 F60000:1001 Ip C444"},
                        Case{59, 2, true, "YUV4MPEG2 W2 H1 F59:1 Ip C444"},
                        Case{25, 1, false, "YUV4MPEG2 W2 H1 F25:1 Ip C444"}}) {
    PictureVideo sink(folder.path("o.y4m"));
    ASSERT_TRUE(sink.open(recording_of(c.rate, c.per), c.interlaced));
    ASSERT_TRUE(sink.commit());

    EXPECT_EQ(first_line(folder, "o.y4m"), c.header);
  }
}

TEST(PictureVideo, HoldsOneFrameAField) {
  const support::TemporaryFolder folder;
  std::vector<std::uint8_t> bytes = {0, 0, 0, 255, 255, 255};
  PictureVideo sink(folder.path("o.y4m"));
  ASSERT_TRUE(sink.open(recording_of(25, 1), true));
  for (std::int64_t field = 0; field < 3; ++field) {
    ASSERT_TRUE(sink.add(field, {bytes.data(), 2, 1, 6}));
  }
  ASSERT_TRUE(sink.commit());

  // Black and white in BT.601's limited range; grey has chroma 128.
  const std::string frame = std::string("FRAME\n\x10\xEB\x80\x80\x80\x80", 12);
  EXPECT_EQ(folder.read("o.y4m"), "YUV4MPEG2 W2 H1 F50:1 Ip C444\n" + frame + frame + frame);
}

TEST(PictureVideo, LeavesNothingWithoutCommit) {
  const support::TemporaryFolder folder;
  {
    PictureVideo sink(folder.path("o.y4m"));
    ASSERT_TRUE(sink.open(recording_of(25, 1), true));
  }

  EXPECT_TRUE(folder.names().empty());
}

TEST(OverlaySink, IsAVideoForAY4mNameOnly) {
  EXPECT_NE(dynamic_cast<PictureVideo*>(make_overlay_sink("a/b.y4m").get()), nullptr);
  EXPECT_EQ(dynamic_cast<PictureVideo*>(make_overlay_sink("a/b.y4m/").get()), nullptr);
  EXPECT_EQ(dynamic_cast<PictureVideo*>(make_overlay_sink("y4m").get()), nullptr);
}

}  // namespace
}  // namespace tubesight::board
