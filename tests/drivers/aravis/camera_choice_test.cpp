#include "drivers/aravis/camera_choice.h"

#include <gtest/gtest.h>

namespace tubesight::tests {
namespace {

using core::Error;
using drivers::aravis::choose_by_serial;

TEST(CameraChoice, ASerialNumberNamesOneCameraOrNone) {
  const std::vector<drivers::aravis::CameraInfo> cameras{
      {"4711", "10.0.0.2", "Maker Model", "GigEVision"},
      {"4712", "10.0.0.3", "Maker Model", "GigEVision"},
      {"4712", "10.0.0.9", "Other Thing", "GigEVision"}};
  std::string why;

  const auto one = choose_by_serial(cameras, "4711", why);
  ASSERT_TRUE(one);
  EXPECT_EQ(*one, 0U);

  const auto two = choose_by_serial(cameras, "4712", why);
  ASSERT_FALSE(two);
  EXPECT_EQ(two.error(), Error::kUnsupported);
  EXPECT_EQ(why,
            "is there more than once (Maker Model at 10.0.0.3, Other Thing at 10.0.0.9), expected "
            "one: name it by its address");

  const auto none = choose_by_serial(cameras, "13", why);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error(), Error::kDisconnected);
  EXPECT_EQ(why, "is not there, expected one of: serial:4711, serial:4712, serial:4712");

  EXPECT_FALSE(choose_by_serial({}, "13", why));
  EXPECT_EQ(why, "is not there, expected one of: no camera answers");
}

}  // namespace
}  // namespace tubesight::tests
