#include "core/tracking/map_watch.h"

#include <initializer_list>

#include <gtest/gtest.h>

namespace tubesight::core::tracking {
namespace {

SiteSightings sites(std::initializer_list<TubeAddress> open,
                    std::initializer_list<TubeAddress> closed = {}) {
  SiteSightings seen;
  for (const TubeAddress address : open) {
    EXPECT_TRUE(seen.open.try_push_back(address));
  }
  for (const TubeAddress address : closed) {
    EXPECT_TRUE(seen.closed.try_push_back(address));
  }
  return seen;
}

TEST(MapWatch, ThreeSitesInTwoFieldsRefuteTheAddresses) {
  MapWatch watch;
  watch.see(sites({{1, 1}, {1, 2}, {5, 5}}));
  EXPECT_FALSE(watch.refuted()) << "one field may be false";
  watch.see(sites({{1, 1}, {1, 2}, {5, 5}}));
  EXPECT_TRUE(watch.refuted());
  watch.begin();
  EXPECT_FALSE(watch.refuted());
}

TEST(MapWatch, TheyNeedNotBeInOnePicture) {
  MapWatch watch;
  for (const std::int32_t column : {1, 5, 9}) {
    EXPECT_FALSE(watch.refuted());
    watch.see(sites({{1, column}}));
    watch.see(sites({{1, column}}));
  }
  EXPECT_TRUE(watch.refuted());
}

TEST(MapWatch, ErrorsOfAListThatAreFarApartAreNotAddedUp) {
  MapWatch watch;
  for (std::int32_t column = 0; column < 200; column += 20) {
    for (int i = 0; i < 30; ++i) {
      watch.see(sites({{1, column}, {3, column}}));
      EXPECT_FALSE(watch.refuted());
    }
    for (int i = 0; i < 60; ++i) {
      watch.see(sites({}));
    }
  }
}

TEST(MapWatch, TwoPlugsThatFellOutRefuteNothingHoweverLongTheyAreSeen) {
  MapWatch watch;
  for (int i = 0; i < 1000; ++i) {
    watch.see(sites({{1, 1}, {1, 2}}, {{2, 2}}));
  }
  EXPECT_FALSE(watch.refuted());
}

TEST(MapWatch, ASiteThatLooksClosedAgainDoesNotCount) {
  MapWatch watch;
  for (int i = 0; i < 10; ++i) {
    watch.see(sites({{1, 1}, {1, 2}, {1, 3}}));
    watch.see(sites({}, {{1, 1}, {1, 2}, {1, 3}}));
    EXPECT_FALSE(watch.refuted());
  }
}

TEST(MapWatch, HasRoomForAsManyAsItTakes) {
  MapWatch watch;
  for (std::int32_t row = 0; row < 24; ++row) {
    watch.see(sites({{row, 0}}));  // each once: none counts
  }
  EXPECT_FALSE(watch.refuted());
  watch.see(sites({{50, 0}, {51, 0}, {52, 0}}));
  watch.see(sites({{50, 0}, {51, 0}, {52, 0}}));
  EXPECT_TRUE(watch.refuted()) << "those that were seen once make room";
}

TEST(MapWatch, AsksEachEighthFieldAndBelievesTwoAnswersInARow) {
  MapWatch watch;
  int asked = 0;
  for (int i = 0; i < 80; ++i) {
    if (watch.asks()) {
      ++asked;
      watch.take_answer(asked % 2 == 0);
    }
  }
  EXPECT_EQ(asked, 10);
  EXPECT_FALSE(watch.refuted()) << "never twice in a row";
  watch.take_answer(true);
  EXPECT_TRUE(watch.refuted());
}

TEST(MapWatch, OneFieldOfAStartMayBeEnough) {
  EXPECT_FALSE(MapWatch::refuted_by(sites({{1, 1}, {1, 2}})));
  EXPECT_TRUE(MapWatch::refuted_by(sites({{1, 1}, {1, 2}, {1, 3}})));
}

}  // namespace
}  // namespace tubesight::core::tracking
