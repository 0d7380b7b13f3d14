#include "core/tracking/field_order_watch.h"

#include <gtest/gtest.h>

#include "tests/core/tracking/tracking_test_support.h"

namespace tubesight::core::tracking {
namespace {

constexpr std::int64_t kField_ns = 16'666'667;

template <typename S>
class FieldOrderWatchOf : public ObservedScene<S> {
 protected:
  using ObservedScene<S>::scene_;
  using ObservedScene<S>::sheet_;
  using ObservedScene<S>::observer_;
  using ObservedScene<S>::frame_;

  void SetUp() override {
    tests::make_synthetic_settings(*scene_.settings, 2);
    scene_.settings->motion = {300.0, 3000.0};
    make();
  }
  void make() {
    ObservedScene<S>::make();
    watch_ = std::make_unique<FieldOrderWatch<S>>(scene_.model);
    watch_->begin();
  }
  [[nodiscard]] static Parity parity_of(int number) {
    return number % 2 == 0 ? Parity::kEven : Parity::kOdd;
  }
  /// A field with the tool so far from where it stood.
  [[nodiscard]] Field draw(int number, double x_mm) {
    ToolPlace place = kOverTube;
    place.x_mm += x_mm;
    Field field;
    field.parity = parity_of(number);
    sheet_->draw(place, field.parity, static_cast<std::uint32_t>(number + 1), frame_);
    field.pixels = sheet_->view(frame_, field.parity);
    return field;
  }
  void believe(int number, double x_mm) {
    Field field;
    field.parity = parity_of(number);
    watch_->believe(field, {Mm<S>(x_mm), Mm<S>{}});
  }
  /// Fields 0 to 5 at rest, then 2000 mm/s^2 in four fields that are looked at aside; field i was
  /// taken at the instant at(i).
  void move(int (*at)(int)) {
    for (int i = 0; i < 6; ++i) {
      believe(i, 0.0);
    }
    const auto last = pose_at<S>(*scene_.settings, *sheet_, kOverTube, kTube);
    for (int i = 6; i < 10; ++i) {
      const double t = at(i) - 5;
      watch_->look_aside(draw(i, 2000.0 / 3600.0 * t * t / 2.0), last, Mm<S>(9.5), i > 6,
                         *observer_);
    }
  }

  std::unique_ptr<FieldOrderWatch<S>> watch_;
};
TYPED_TEST_SUITE(FieldOrderWatchOf, Scalars);

TYPED_TEST(FieldOrderWatchOf, ExplainsContradictionsBySwappedFields) {
  ASSERT_EQ(this->scene_.model.first_field, Parity::kEven);
  this->move([](int i) { return i % 2 == 0 ? i + 1 : i - 1; });
  EXPECT_FALSE(this->watch_->wrong()) << "nothing of it was believed";
  EXPECT_TRUE(this->watch_->explains(kField_ns));
}

TYPED_TEST(FieldOrderWatchOf, ExplainsNothingOfAMoveInOrder) {
  this->move([](int i) { return i; });
  EXPECT_FALSE(this->watch_->explains(kField_ns));
}

TYPED_TEST(FieldOrderWatchOf, ExplainsNothingWithoutFields) {
  this->scene_.model.first_field = Parity::kProgressive;
  this->move([](int i) { return i % 2 == 0 ? i + 1 : i - 1; });
  EXPECT_FALSE(this->watch_->explains(kField_ns));
}

TYPED_TEST(FieldOrderWatchOf, FindsTheOrderWrongInWhatIsBelieved) {
  for (int i = 0; i < 80; ++i) {
    this->believe(i, 0.1 * (i + (i % 2 == 0 ? 1 : -1)));
  }
  EXPECT_TRUE(this->watch_->wrong());
  EXPECT_TRUE(this->watch_->explains(kField_ns));
  this->watch_->begin();
  EXPECT_FALSE(this->watch_->wrong());
}

TYPED_TEST(FieldOrderWatchOf, IsNotMisledByAChangeOfTheAnchor) {
  for (int i = 0; i < 80; ++i) {
    const double from = 25.4 * (i / 8);  // another anchor every eight fields
    if (i % 8 == 0 && i > 0) {
      this->watch_->move_anchor({Mm<TypeParam>(25.4), Mm<TypeParam>{}});
    }
    this->believe(i, 0.1 * (i + (i % 2 == 0 ? 1 : -1)) - from);
  }
  EXPECT_TRUE(this->watch_->wrong());
}

TYPED_TEST(FieldOrderWatchOf, LooksNoFurtherAsideOnceTheToolIsOutOfReach) {
  const auto last = pose_at<TypeParam>(*this->scene_.settings, *this->sheet_, kOverTube, kTube);
  for (int i = 0; i < 6; ++i) {
    this->believe(i, 0.0);
  }
  // A jump of half a step leaves sheet where tube-ends must be; what comes behind is not looked at.
  for (int i = 6; i < 10; ++i) {
    this->watch_->look_aside(this->draw(i, 12.7), last, Mm<TypeParam>(2.0), i > 6,
                             *this->observer_);
  }
  EXPECT_FALSE(this->watch_->explains(kField_ns));
}

}  // namespace
}  // namespace tubesight::core::tracking
