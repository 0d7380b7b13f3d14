#include "core/tracking/old_picture_watch.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/tracking/noisy_picture.h"

namespace tubesight::core::tracking {
namespace {

using Source = OldPictureWatch::Source;

/// A watch shown grey pictures whose noise is `seed`'s.
class OldPictureWatchOf : public NoisyPicture {
 protected:
  bool look(std::uint32_t seed) {
    draw(seed);
    return show();
  }
  bool show(bool moves = false) {
    Field field;
    field.parity = Parity::kProgressive;
    field.pixels = view(field.parity);
    return watch_.shows_old(field, kWindow, moves);
  }
  /// A picture that is dark but for so many of its ten lines of blocks, seven each.
  bool look_at_lines(std::uint32_t seed, std::int32_t lines) {
    draw(seed);
    std::fill(pixels_.begin() + (20 + 18 * lines) * kWidth, pixels_.end(), std::uint8_t{10});
    return show();
  }
  /// Shows and believes fields at rest with the noises of these seeds.
  void rest(std::uint32_t first, std::uint32_t fields) {
    for (std::uint32_t seed = first; seed < first + fields; ++seed) {
      EXPECT_FALSE(look(seed));
      watch_.believe(Rest::kStill);
    }
  }
  /// A rest as a compressor shows it: most of the picture as it was, a part of it anew, coarsely.
  void rest_compressed(std::uint32_t first, std::uint32_t fields) {
    draw(first);
    for (std::uint32_t seed = first; seed < first + fields; ++seed) {
      const std::vector<std::uint8_t> before = pixels_;
      draw(seed);
      for (std::uint8_t& pixel : pixels_) {
        pixel = static_cast<std::uint8_t>(pixel / 2 * 2);
      }
      keep_left(before, 220);
      EXPECT_FALSE(show());
      watch_.believe(Rest::kStill);
    }
  }
  /// Whether a store that shows `old` with such noise is found in so many fields.
  int found_under_noise(double deviation, int fields) {
    const std::vector<std::uint8_t> old = pixels_;
    int found = 0;
    for (int i = 0; i < fields; ++i) {
      pixels_ = old;
      add_noise(static_cast<std::uint32_t>(1000 + i), deviation);
      found += show() ? 1 : 0;
    }
    return found;
  }

  OldPictureWatch watch_;
};

TEST_F(OldPictureWatchOf, FindsAPictureDeliveredAgainOnceNoiseIsKnown) {
  rest(1, 3);
  EXPECT_FALSE(look(4));
  EXPECT_TRUE(look(4));
}

TEST_F(OldPictureWatchOf, FindsATornField) {
  rest(1, 3);
  const std::vector<std::uint8_t> old = pixels_;
  draw(4);
  std::copy(old.begin() + 150 * kWidth, old.end(), pixels_.begin() + 150 * kWidth);
  EXPECT_TRUE(show());
}

TEST_F(OldPictureWatchOf, FindsAStoreBesideALiveStrip) {
  rest(1, 8);
  const std::vector<std::uint8_t> old = pixels_;
  for (std::uint32_t seed = 20; seed < 25; ++seed) {
    draw(seed);
    keep_left(old, 100);
    EXPECT_TRUE(show()) << "two blocks of seven are old";
  }
}

TEST_F(OldPictureWatchOf, FindsAStoreUnderLittleNoise) {
  rest(1, 8);
  EXPECT_EQ(found_under_noise(0.25, 5), 5);
}

TEST_F(OldPictureWatchOf, FindsAStoreUnderNoiseThatIsTheCamerasLessItsOwn) {
  rest(1, 8);
  // 1.25 is the camera's variance: half of it is the line's. The first field may yet be chance.
  EXPECT_EQ(found_under_noise(0.79, 6), 5);
}

TEST_F(OldPictureWatchOf, CannotTellAStoreUnderMoreNoiseThanTheCamera) {
  rest(1, 8);
  EXPECT_EQ(found_under_noise(2.0, 6), 0);
}

TEST_F(OldPictureWatchOf, BelievesALongRest) {
  rest(1, 2000);
  EXPECT_EQ(watch_.source(), Source::kNoisy);
}

TEST_F(OldPictureWatchOf, BelievesAPictureThatGetsDarkerWithItsNoise) {
  rest(1, 8);
  const std::vector<std::uint8_t> flat(pixels_.size(), 60);
  for (std::uint32_t seed = 20; seed < 60; ++seed) {
    pixels_ = flat;
    add_noise(seed, 0.8);  // half of the light, half of the variance
    EXPECT_FALSE(show()) << seed;
    watch_.believe(Rest::kStill);
  }
}

TEST_F(OldPictureWatchOf, BelievesAPictureThatLosesContrastAndNoise) {
  const auto show_striped = [&](std::uint32_t seed, int dark, int bright) {
    draw_stripes(0, 24, dark, bright);
    add_noise(seed, seed < 20 ? 1.2 : 0.6);
    const bool old = show();
    watch_.believe(Rest::kStill);
    return old;
  };
  for (std::uint32_t seed = 1; seed < 9; ++seed) {
    EXPECT_FALSE(show_striped(seed, 60, 160));
  }
  for (std::uint32_t seed = 20; seed < 60; ++seed) {
    EXPECT_FALSE(show_striped(seed, 94, 144)) << "black is raised by half: " << seed;
  }
}

TEST_F(OldPictureWatchOf, TakesNoPatchWithoutNoiseForAnOldPicture) {
  rest(1, 8);
  const std::vector<std::uint8_t> patch(pixels_.size(), 25);
  for (std::uint32_t seed = 20; seed < 30; ++seed) {
    draw(seed);
    keep_left(patch, 200);
    EXPECT_FALSE(show()) << "a shutter, a title, not what was there before";
  }
}

TEST_F(OldPictureWatchOf, CallsNoPictureOldThatHasNoNoise) {
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(look(1)) << "a drawn picture of a tool at rest is always the same";
    watch_.believe(Rest::kStill);
  }
  EXPECT_EQ(watch_.source(), Source::kRepeating);
}

TEST_F(OldPictureWatchOf, RecognisesACompressedSourceAndDoesNotCallItOld) {
  rest_compressed(1, 8);
  EXPECT_EQ(watch_.source(), Source::kRepeating);
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(show()) << "all blocks are skipped";
    watch_.believe(Rest::kStill);
  }
  rest_compressed(40, 4);
}

TEST_F(OldPictureWatchOf, WaitsWhereACompressorMaySendAWholePictureAnew) {
  rest(1, 2);
  const std::vector<std::uint8_t> before = pixels_;
  draw(3);
  keep_left(before, 30);  // a seventh is as before
  EXPECT_FALSE(show());
  watch_.believe(Rest::kStill);
  EXPECT_EQ(watch_.source(), Source::kUnknown);
}

TEST_F(OldPictureWatchOf, FindsEdgesThatStandWhileTheToolMovesInAnySource) {
  draw_stripes(0);
  EXPECT_FALSE(show());
  draw_stripes(3);
  EXPECT_FALSE(show(true));
  EXPECT_TRUE(show(true)) << "nothing was learnt";
  EXPECT_FALSE(show(false)) << "a drawn picture at rest";
  draw_stripes(6);
  EXPECT_FALSE(show(true));
}

// A store that holds a field of each parity: to and fro, and each turn looks like the motion's end.
TEST_F(OldPictureWatchOf, TellsPicturesThatAreOldAgainWithoutFreshEdges) {
  draw_stripes(0);
  show();
  EXPECT_TRUE(show(true));
  EXPECT_FALSE(show(false));
  EXPECT_FALSE(watch_.stays_old());
  EXPECT_TRUE(show(true)) << "once more";
  EXPECT_TRUE(watch_.stays_old());
}

TEST_F(OldPictureWatchOf, LetsALivePictureBeTakenForAnOldOneNowAndThen) {
  for (std::int32_t stop = 0; stop < 10; ++stop) {
    draw_stripes(3 * stop);
    show(true);
    EXPECT_TRUE(show(true)) << "the first field of a stop";
    EXPECT_FALSE(show(false));
  }
  EXPECT_FALSE(watch_.stays_old()) << "in between it moved";
}

TEST_F(OldPictureWatchOf, LearnsOnlyFromThreeFieldsAtRestInARow) {
  rest(1, 2);
  EXPECT_FALSE(look(3));
  watch_.believe(Rest::kNone);  // it moved: that is why the pictures differ
  rest(4, 2);
  EXPECT_FALSE(look(5)) << "equal, but nothing has shown noise yet";
  rest(6, 3);
  EXPECT_TRUE(look(8));
}

// A docked tool sees next to nothing but dark plate.
TEST_F(OldPictureWatchOf, LearnsFromSeveralFieldsOfWhichEachShowsLittle) {
  const auto rest_at = [&](std::uint32_t fields, std::int32_t lines) {
    watch_.begin();
    for (std::uint32_t seed = 1; seed <= fields; ++seed) {
      EXPECT_FALSE(look_at_lines(seed, lines));
      watch_.believe(Rest::kStill);
    }
    return watch_.source();
  };
  EXPECT_EQ(rest_at(4, 2), Source::kUnknown) << "14 blocks, compared at rest twice";
  EXPECT_EQ(rest_at(5, 2), Source::kNoisy);
  EXPECT_TRUE(look_at_lines(5, 2)) << "the store stops";
  EXPECT_EQ(rest_at(40, 1), Source::kUnknown) << "seven blocks may be all that was sent anew";
}

TEST_F(OldPictureWatchOf, LearnsNothingFromLittleThatComesAgainNowAndThen) {
  for (std::uint32_t i = 0; i < 40; ++i) {
    EXPECT_FALSE(look_at_lines(i / 2, 2));
    watch_.believe(Rest::kStill);
  }
  EXPECT_EQ(watch_.source(), Source::kUnknown);
}

// The plate's grain moves a little, which looks like noise that live pictures lack later.
TEST_F(OldPictureWatchOf, LearnsNotHowMuchNoiseThereIsFromWhatIsNearlyAtRest) {
  const std::vector<std::uint8_t> flat(pixels_.size(), 120);
  const auto show_with = [&](std::uint32_t seed, double deviation, Rest rest) {
    pixels_ = flat;
    add_noise(seed, deviation);
    const bool old = show();
    watch_.believe(rest);
    return old;
  };
  for (std::uint32_t seed = 1; seed < 12; ++seed) {
    EXPECT_FALSE(show_with(seed, 3.0, Rest::kNearly));
  }
  EXPECT_EQ(watch_.source(), Source::kNoisy);
  for (std::uint32_t seed = 20; seed < 40; ++seed) {
    EXPECT_FALSE(show_with(seed, 1.0, Rest::kStill)) << seed;
  }
  EXPECT_FALSE(show_with(50, 1.0, Rest::kStill));
  EXPECT_TRUE(show()) << "but that there is noise is known";
}

TEST_F(OldPictureWatchOf, LearnsNothingFromFieldsThatWereNotBelieved) {
  for (std::uint32_t seed = 1; seed < 9; ++seed) {
    EXPECT_FALSE(look(seed));
  }
  EXPECT_FALSE(look(8));
}

TEST_F(OldPictureWatchOf, ForgetsWithANewStart) {
  rest(1, 3);
  watch_.begin();
  EXPECT_FALSE(look(3));
  EXPECT_FALSE(look(3));
}

}  // namespace
}  // namespace tubesight::core::tracking
