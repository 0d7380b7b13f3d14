#include "drivers/modbus/tcp_framer.h"

#include <vector>

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Found = TcpFramer::Found;

Found send(TcpFramer& framer, const Bytes& bytes) {
  Found found = Found::kNothing;
  for (const std::uint8_t byte : bytes) {
    framer.append(byte);
    found = framer.next();
    if (found != Found::kNothing) {
      break;
    }
  }
  return found;
}

TEST(TcpFramer, FindsARequestAndWrapsItsAnswer) {
  TcpFramer framer;

  ASSERT_EQ(send(framer, {0x12, 0x34, 0, 0, 0, 6, 17, 3, 0, 107, 0, 3}), Found::kRequest);

  EXPECT_EQ(framer.unit(), 17);
  EXPECT_EQ(Bytes(framer.request().begin(), framer.request().end()), (Bytes{3, 0, 107, 0, 3}));
  TcpFrame frame;
  const Bytes answer{0x83, 2};
  framer.wrap(answer, frame);
  EXPECT_EQ(Bytes(frame.begin(), frame.end()), (Bytes{0x12, 0x34, 0, 0, 0, 3, 17, 0x83, 2}));
}

TEST(TcpFramer, GivesUpOnWhatIsNotModbus) {
  for (const Bytes& wrong : {Bytes{0, 1, 0, 1, 0, 6}, Bytes{0, 1, 0, 0, 0, 1},
                             Bytes{0, 1, 0, 0, 0, 255}, Bytes{'G', 'E', 'T', ' ', '/', ' '}}) {
    TcpFramer framer;
    EXPECT_EQ(send(framer, wrong), Found::kBroken);
  }
}

TEST(TcpFramer, TakesTheLongest) {
  TcpFramer framer;
  Bytes request{0, 1, 0, 0, 0, 254, 1};
  request.resize(6 + 254, 7);

  EXPECT_EQ(send(framer, request), Found::kRequest);
  EXPECT_EQ(framer.request().size(), 253u);
}

}  // namespace
}  // namespace tubesight::drivers
