#include "core/pose/pose_request_job.h"

#include <memory>

#include <gtest/gtest.h>

#include "tests/core/pose/still_picture.h"

namespace tubesight::core::pose {
namespace {

class PoseRequestJobOf : public ::testing::Test {
 protected:
  PoseRequestJobOf() {
    still_.sheet->look.noise = 2.0;
    order_.wanted = true;
    for (const TubeAddress tube : {TubeAddress{19, 10}, TubeAddress{20, 10}, TubeAddress{19, 11}}) {
      const auto at = still_.sheet->image_of(kStillPlace, tube);
      EXPECT_TRUE(order_.tubes.try_push_back({tube,
                                              {static_cast<std::int32_t>(at[0] * 65536.0),
                                               static_cast<std::int32_t>(at[1] * 65536.0)}}));
    }
  }

  void add(const tests::ToolPlace& place, FieldStatus status = FieldStatus::kGood) {
    const Parity parity = sequence_ % 2 == 0 ? Parity::kEven : Parity::kOdd;
    still_.sheet->draw(place, parity, static_cast<std::uint32_t>(sequence_), still_.frame);
    job_->add_field({still_.field(parity), parity, status, sequence_++, FieldTime(0)});
  }

  StillPicture still_;
  PoseOrder order_;
  std::int64_t sequence_ = 0;
  std::unique_ptr<PictureWorkspace> workspace_ = std::make_unique<PictureWorkspace>();
  std::unique_ptr<PoseRequestJob> job_ =
      std::make_unique<PoseRequestJob>(still_.model, *still_.map, still_.sums, *workspace_);
};

TEST_F(PoseRequestJobOf, AToolAtRestTellsItsPose) {
  job_->begin(order_, 4);
  while (!job_->ready()) {
    ASSERT_LT(sequence_, 4);
    add(kStillPlace);
  }

  const PoseResult result = job_->compute();

  ASSERT_EQ(result.reason, PoseReason::kNone);
  EXPECT_NEAR(static_cast<double>(result.position_nm[0]) * 1e-6, kStillPlace.x_mm, 0.02);
  EXPECT_NEAR(static_cast<double>(result.position_nm[1]) * 1e-6, kStillPlace.y_mm, 0.02);
  EXPECT_NEAR(static_cast<double>(result.position_nm[2]) * 1e-6, -kStillPlace.height_mm, 0.02);
  EXPECT_NEAR(static_cast<double>(result.angles_ndeg[0]) * 1e-9, kStillPlace.alpha_deg, 0.02);
  EXPECT_NEAR(static_cast<double>(result.angles_ndeg[1]) * 1e-9, kStillPlace.beta_deg, 0.02);
  EXPECT_NEAR(static_cast<double>(result.angles_ndeg[2]) * 1e-9, kStillPlace.gamma_deg, 0.02);
  EXPECT_EQ(result.nearest, kUnderTube);
  EXPECT_FALSE(job_->active());
}

TEST_F(PoseRequestJobOf, AMovingToolIsRefused) {
  job_->begin(order_, 4);
  tests::ToolPlace place = kStillPlace;
  while (!job_->ready()) {
    add(place);
    place.x_mm += 1.0;
  }

  EXPECT_EQ(job_->compute().reason, PoseReason::kMoving);
}

TEST_F(PoseRequestJobOf, DamagedFieldsArePassedOver) {
  job_->begin(order_, 2);
  add(kStillPlace, FieldStatus::kDamaged);
  add(kStillPlace, FieldStatus::kDamaged);
  EXPECT_FALSE(job_->ready());
  add(kStillPlace);
  add(kStillPlace);

  EXPECT_TRUE(job_->ready());
}

TEST_F(PoseRequestJobOf, TooFewFieldsAreToldAsEnded) {
  job_->begin(order_, 4);
  add(kStillPlace);

  EXPECT_EQ(job_->compute().reason, PoseReason::kEnded);
  EXPECT_FALSE(job_->active());
}

TEST_F(PoseRequestJobOf, TubesThatTheTrackerHasWrongAreRefused) {
  order_.tubes[0].center_px.v_q16 += 30 * 65536;
  job_->begin(order_, 2);
  add(kStillPlace);
  add(kStillPlace);

  const PoseResult result = job_->compute();

  EXPECT_NE(result.reason, PoseReason::kNone);
}

}  // namespace
}  // namespace tubesight::core::pose
