#include "drivers/modbus/rtu_framer.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/modbus/crc16.h"

namespace tubesight::drivers {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kUnit = 0x11;
// "Modbus over serial line" and many a manual: read 3 registers from 107 of unit 17.
const Bytes kRead{0x11, 0x03, 0x00, 0x6B, 0x00, 0x03, 0x76, 0x87};

Bytes with_crc(Bytes bytes) {
  const std::uint16_t crc = crc16(bytes);
  bytes.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8));
  return bytes;
}

Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

/// What a framer found in some bytes.
struct Line {
  LinkCounters counters;
  RtuFramer framer{kUnit, counters};
  std::vector<Bytes> requests;
  std::vector<Bytes> broadcasts;

  void take(Found found) {
    const Bytes request(framer.request().begin(), framer.request().end());
    if (found == Found::kRequest) {
      requests.push_back(request);
    } else if (found == Found::kBroadcast) {
      broadcasts.push_back(request);
    }
  }
  void send(const Bytes& bytes) {
    for (const std::uint8_t byte : bytes) {
      framer.append(byte);
      for (Found found = framer.next(); found != Found::kNothing; found = framer.next()) {
        take(found);
      }
    }
  }
  void silence() { take(framer.silence()); }
};

const Bytes kReadRequest{0x03, 0x00, 0x6B, 0x00, 0x03};

TEST(Crc16, IsThatOfPublishedFrames) {
  EXPECT_EQ(crc16(std::span(kRead).first(6)), 0x8776);
  const Bytes check{'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc16(check), 0x4B37);  // catalogue of CRC algorithms, CRC-16/MODBUS
  EXPECT_EQ(crc16(kRead), 0);
}

TEST(RtuFramer, FindsARequestWithItsLastByte) {
  Line line;
  line.send(Bytes(kRead.begin(), kRead.end() - 1));
  EXPECT_TRUE(line.requests.empty());
  EXPECT_TRUE(line.framer.waits());

  line.send({kRead.back()});

  ASSERT_EQ(line.requests.size(), 1u);
  EXPECT_EQ(line.requests[0], kReadRequest);
  EXPECT_FALSE(line.framer.waits());
  EXPECT_EQ(line.counters.requests, 1u);
}

TEST(RtuFramer, DropsAWrongCheckSumAndCountsIt) {
  Line line;
  Bytes wrong = kRead;
  wrong[3] ^= 1;
  line.send(wrong);
  line.silence();
  EXPECT_TRUE(line.requests.empty());
  EXPECT_EQ(line.counters.crc_errors, 1u);

  line.send(kRead);
  EXPECT_EQ(line.requests.size(), 1u);
}

TEST(RtuFramer, ACutFrameEndsWithTheSilence) {
  for (std::size_t cut = 1; cut < kRead.size(); ++cut) {
    Line line;
    line.send(Bytes(kRead.begin(), kRead.begin() + static_cast<std::ptrdiff_t>(cut)));
    line.silence();
    line.send(kRead);

    EXPECT_EQ(line.requests.size(), 1u) << cut;
    EXPECT_EQ(line.counters.cut_frames, 1u) << cut;
    EXPECT_EQ(line.counters.crc_errors, 0u) << cut;
  }
}

TEST(RtuFramer, AFrameOfAnotherLengthIsFoundBySilence) {
  Line line;
  line.send(with_crc({kUnit, 16, 1, 44, 0, 2, 4, 0, 0}));  // says 4 bytes, has 2
  EXPECT_TRUE(line.requests.empty());
  line.silence();
  ASSERT_EQ(line.requests.size(), 1u);

  line.send(with_crc({kUnit, 3, 0, 0, 0, 1, 9, 9}));  // too long
  line.silence();
  EXPECT_EQ(line.requests.size(), 2u);
  EXPECT_EQ(line.counters.crc_errors, 0u);
}

TEST(RtuFramer, FindsUnknownFunctions) {
  Line line;
  line.send(with_crc({kUnit, 99, 1, 2, 3}));
  EXPECT_TRUE(line.requests.empty()) << "it may be longer";
  line.silence();

  ASSERT_EQ(line.requests.size(), 1u);
  EXPECT_EQ(line.requests[0], (Bytes{99, 1, 2, 3}));
}

TEST(RtuFramer, AnExceptionIsNoRequest) {
  Line line;
  line.send(with_crc({kUnit, 0x83, 2}));
  line.send(kRead);
  ASSERT_EQ(line.requests.size(), 1u) << "the request behind it, without any silence";
  EXPECT_EQ(line.requests[0], kReadRequest);
  EXPECT_EQ(line.counters.stray_bytes, 5u);

  line.send(with_crc({kUnit, 0x83, 2, 9, 9}));
  line.silence();
  line.send(Bytes{0xFF} + with_crc({kUnit, 0x83, 2}));
  line.silence();
  EXPECT_EQ(line.requests.size(), 1u);
  EXPECT_EQ(line.counters.requests, 1u);
}

TEST(RtuFramer, TellsBroadcastsApart) {
  Line line;
  line.send(with_crc({0, 6, 1, 74, 2, 128}));

  EXPECT_TRUE(line.requests.empty());
  ASSERT_EQ(line.broadcasts.size(), 1u);
  EXPECT_EQ(line.broadcasts[0], (Bytes{6, 1, 74, 2, 128}));
}

TEST(RtuFramer, FollowsADeadNeighbour) {
  Line line;
  for (int i = 0; i < 3; ++i) {
    line.send(with_crc({5, 3, 0, 0, 0, 2}));  // never answered
    line.send(kRead);
  }

  EXPECT_EQ(line.requests.size(), 3u);
  EXPECT_EQ(line.counters.other_units, 3u);
}

TEST(RtuFramer, TakesNothingOutOfANeighboursAnswer) {
  Line line;
  // Its data are a whole request to us.
  Bytes answer{5, 3, 8};
  answer = with_crc(answer + kRead);

  line.send(with_crc({5, 3, 0, 0, 0, 4}));
  line.send(answer);

  EXPECT_TRUE(line.requests.empty());
  EXPECT_EQ(line.counters.other_units, 2u);
  line.send(kRead);
  EXPECT_EQ(line.requests.size(), 1u) << "without any silence between";
}

TEST(RtuFramer, FollowsEveryFunctionOfNeighbours) {
  Line line;
  const std::vector<Bytes> pairs{{5, 1, 0, 0, 0, 9},
                                 {5, 1, 2, 7, 1},
                                 {5, 6, 0, 1, 0, 2},
                                 {5, 6, 0, 1, 0, 2},
                                 {5, 16, 0, 1, 0, 1, 2, 0, 7},
                                 {5, 16, 0, 1, 0, 1},
                                 {5, 22, 0, 4, 0, 0xF2, 0, 0x25},
                                 {5, 22, 0, 4, 0, 0xF2, 0, 0x25},
                                 {5, 23, 0, 3, 0, 2, 0, 14, 0, 1, 2, 0, 0xFF},
                                 {5, 23, 4, 0, 0xFE, 0xA, 0xCD},
                                 {5, 3, 0, 0, 0, 0},
                                 {5, 0x83, 3},
                                 {5, 17},
                                 {5, 17, 2, 1, 0xFF},
                                 {5, 7},
                                 {5, 7, 0x6D},
                                 {5, 43, 14, 1, 0},
                                 {5, 43, 14, 1, 1, 0, 0, 0}};
  for (const Bytes& frame : pairs) {
    line.send(with_crc(frame));
  }
  line.send(kRead);

  EXPECT_EQ(line.requests.size(), 1u);
  EXPECT_EQ(line.counters.other_units, pairs.size());
  EXPECT_EQ(line.counters.stray_bytes, 0u);
}

TEST(RtuFramer, LooksPastGlitchesInFrontOfAFrame) {
  Line line;
  line.send(Bytes{0xFF, 0x00} + kRead);
  line.silence();

  ASSERT_EQ(line.requests.size(), 1u);
  EXPECT_EQ(line.requests[0], kReadRequest);
  EXPECT_EQ(line.counters.stray_bytes, 2u);
}

TEST(RtuFramer, ComesBackInAFloodThatNeverPauses) {
  Line line;
  Bytes wrong = kRead;
  wrong[2] ^= 4;
  line.send(wrong);
  for (int i = 0; i < 100; ++i) {
    line.send(kRead);
  }

  EXPECT_GE(line.requests.size(), 99u) << "after 256 bytes those that wait are found";
}

TEST(RtuFramer, NoiseIsNeverARequestAndTheNextFrameIsFound) {
  Line line;
  std::mt19937 dice(7);  // NOLINT
  for (int burst = 0; burst < 2000; ++burst) {
    for (auto left = dice() % 300; left > 0; --left) {
      line.send({static_cast<std::uint8_t>(dice() % 256)});
    }
    line.silence();
    const std::size_t before = line.requests.size();
    line.send(kRead);
    ASSERT_EQ(line.requests.size(), before + 1) << burst;
  }
  EXPECT_EQ(line.requests.size(), 2000u);
}

TEST(RtuFramer, WrapsAnswers) {
  RtuFrame frame;
  RtuFramer::wrap(kUnit, kReadRequest, frame);

  EXPECT_EQ(Bytes(frame.begin(), frame.end()), kRead);
}

}  // namespace
}  // namespace tubesight::drivers
