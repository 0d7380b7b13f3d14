#include "board/visionbox/golden_recording.h"

#include <chrono>
#include <string>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(GoldenRecording, IsJudgedAsOnEveryMachine) {
  const GoldenResult result = run_golden_recording();

  EXPECT_TRUE(result.ran);
  EXPECT_TRUE(result.good)
      << result.words << "; where the tracking was changed on purpose, kGolden changes with it";
}

TEST(GoldenRecording, FindsAnotherPictureAndAnotherJudgement) {
  GoldenDigests other = kGolden;
  other.pictures ^= 1;
  const GoldenResult drawn = run_golden_recording(other);
  EXPECT_TRUE(drawn.ran);
  EXPECT_FALSE(drawn.good);
  EXPECT_TRUE(has(drawn.words, "the golden recording is drawn otherwise than it must be: "))
      << drawn.words;

  other = kGolden;
  other.sightings ^= 1;
  const GoldenResult judged = run_golden_recording(other);
  EXPECT_FALSE(judged.good);
  EXPECT_TRUE(has(judged.words, "the golden recording is judged otherwise than it must be: "))
      << judged.words;
}

}  // namespace
}  // namespace tubesight::board
