#include "drivers/camera/camera_identity.h"

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

TEST(CameraIdentity, TheCalibratedCameraIsTakenAndNoOther) {
  const IdentityWatch watch({"4711", "Maker Model"});

  EXPECT_EQ(watch.refusal({"4711", "Maker Model"}), "");
  EXPECT_EQ(watch.refusal({"4712", "Maker Model"}),
            "has the serial number 4712, expected 4711, the one that was calibrated");
  EXPECT_EQ(watch.refusal({"", "Maker Model"}),
            "says no serial number, expected 4711, the one that was calibrated");
  EXPECT_EQ(watch.refusal({"4711", "Maker Other"}),
            "is 'Maker Other', expected 'Maker Model', the one that was calibrated");
  EXPECT_EQ(watch.refusal({"4711", ""}),
            "says no model, expected 'Maker Model', the one that was calibrated");
}

TEST(CameraIdentity, AnUnboundCalibrationTakesAnyCameraAndSaysSo) {
  IdentityWatch watch(CameraIdentity{});
  EXPECT_EQ(watch.refusal({"4711", "Maker Model"}), "");
  EXPECT_EQ(watch.doubt(), "") << "none is used yet";

  watch.keep({"4711", "Maker Model"});
  EXPECT_EQ(watch.doubt(),
            "calibration is bound to no camera: this one is serial = \"4711\", model = \"Maker "
            "Model\"");
  watch.keep({"", "Maker Model"});
  EXPECT_EQ(watch.doubt(),
            "calibration is bound to no camera: this one is model = \"Maker Model\"");
}

TEST(CameraIdentity, AModelAloneLeavesTheNumberOpen) {
  IdentityWatch watch({"", "Maker Model"});
  watch.keep({"4711", "Maker Model"});
  EXPECT_EQ(watch.doubt(),
            "calibration is bound to a model and to no camera of it: this one is serial = "
            "\"4711\"");
  watch.keep({"", "Maker Model"});
  EXPECT_EQ(watch.doubt(), "") << "the camera says no more";
}

TEST(CameraIdentity, ANumberLeavesNothingOpen) {
  IdentityWatch watch({"4711", ""});
  watch.keep({"4711", "Maker Model"});
  EXPECT_EQ(watch.doubt(), "");
}

// Plugged in at the same place while the box runs: nobody has said that it is calibrated.
TEST(CameraIdentity, TheCameraThatWasUsedFirstIsKept) {
  IdentityWatch watch(CameraIdentity{});
  watch.keep({"4711", "Maker Model"});
  EXPECT_EQ(watch.refusal({"4711", "Maker Model"}), "");
  EXPECT_EQ(watch.refusal({"4712", "Maker Model"}),
            "has the serial number 4712, expected 4711, the one that this box has used so far");
  EXPECT_EQ(watch.refusal({"4711", "Maker Other"}),
            "is 'Maker Other', expected 'Maker Model', the one that this box has used so far");

  watch.keep({"", "Maker Model"});
  EXPECT_EQ(watch.refusal({"", "Maker Model"}), "");
  EXPECT_EQ(watch.refusal({"4711", "Maker Model"}),
            "has the serial number 4711, expected one without, the one that this box has used so "
            "far");
}

}  // namespace
}  // namespace tubesight::drivers
