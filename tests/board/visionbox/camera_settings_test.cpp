#include "board/visionbox/camera_settings.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/board/visionbox/box_settings_bench.h"

namespace tubesight::board {
namespace {

using CameraSettingsTest = BoxSettingsTest;

TEST_F(CameraSettingsTest, ACameraNeedsItsNameAlone) {
  ASSERT_TRUE(load(kCamera)) << messages_.front();

  EXPECT_EQ(box_->source.kind, SourceKind::kV4l2);
  const drivers::V4l2Settings& camera = box_->source.v4l2;
  EXPECT_EQ(camera.device, "serial:12");
  EXPECT_EQ(camera.format, "");
  EXPECT_EQ(camera.fields, drivers::FieldLayout::kAny);
  EXPECT_EQ(camera.width_px, box_->told().camera.width_px) << "of the session";
  EXPECT_EQ(camera.height_px, box_->told().camera.height_px);
  EXPECT_EQ(camera.scan, box_->told().camera.scan);
  EXPECT_EQ(camera.calibrated.serial, "") << "the calibration names none";
}

TEST_F(CameraSettingsTest, MotionThatNoTrackCanFollowIsRefused) {
  EXPECT_FALSE(load(std::string(kCamera) +
                    "[motion]\nmax_speed_mm_s = 1600\nmax_acceleration_mm_s2 = 100000\n"));
  EXPECT_TRUE(told("motion: 60 fields a second are too few"));
  EXPECT_TRUE(told("or 110 fields a second"));
  const std::string fast = "[motion]\nmax_speed_mm_s = 1600\nmax_acceleration_mm_s2 = 8000\n";
  EXPECT_FALSE(load(std::string(kCamera) + "fields_per_s = 25\n" + fast));
  EXPECT_TRUE(told("motion: 25 fields a second are too few"));
  EXPECT_TRUE(load(std::string(kCamera) + "fields_per_s = 50\n" + fast)) << messages_.front();
}

TEST_F(CameraSettingsTest, EveryKeyOfACameraIsRead) {
  ASSERT_TRUE(
      load(std::string(kCamera) +
           "format = \"Y10\"\nfields = \"alternate\"\ninput = \"S-Video\"\n"
           "standard = \"PAL\"\nfields_per_s = 50\nexposure_ms = 2.5\n"
           "controls = [\"Gain = 20\", \" Exposure Mode=Manual Mode \"]\n"
           "stamps = \"arrival\"\n"
           "[camera_quality]\nid = \"c1\"\nserial = \"4711\"\nmodel = \"em28xx Grabber\"\n"))
      << messages_.front();

  const drivers::V4l2Settings& camera = box_->source.v4l2;
  EXPECT_EQ(camera.format, "Y10");
  EXPECT_EQ(camera.fields, drivers::FieldLayout::kAlternate);
  EXPECT_EQ(camera.input, "S-Video");
  EXPECT_EQ(camera.standard, "PAL");
  EXPECT_EQ(camera.fields_per_s, 50.0);
  EXPECT_EQ(camera.exposure_ms, 2.5);
  EXPECT_FALSE(camera.use_stamps);
  ASSERT_EQ(camera.controls.size(), 2u);
  EXPECT_EQ(camera.controls[0].name, "Gain");
  EXPECT_EQ(camera.controls[0].value, "20");
  EXPECT_EQ(camera.controls[1].name, "Exposure Mode");
  EXPECT_EQ(camera.controls[1].value, "Manual Mode");
  EXPECT_EQ(camera.calibrated.serial, "4711") << "of the calibration";
  EXPECT_EQ(camera.calibrated.model, "em28xx Grabber");
}

TEST_F(CameraSettingsTest, ACameraIsNamedByWhatStays) {
  for (const char* name : {"/dev/video0", "serial:", "bus:", "video0", ""}) {
    EXPECT_FALSE(load(std::string("[source]\nkind = \"v4l2\"\ndevice = \"") + name + "\"\n"));
    EXPECT_TRUE(told("source.device: '" + std::string(name) +
                     "' is another camera after the next start, expected serial:NUMBER"));
  }
  for (const char* name : {"/dev/v4l/by-path/a", "/dev/v4l/by-id/b", "bus:usb-1"}) {
    EXPECT_TRUE(load(std::string("[source]\nkind = \"v4l2\"\ndevice = \"") + name + "\"\n"));
  }
}

TEST_F(CameraSettingsTest, MistakesOfACameraAreTold) {
  EXPECT_FALSE(
      load("[source]\nkind = \"v4l2\"\nformat = \"MJPG\"\nfields = \"odd\"\n"
           "standard = \"SECAM\"\nfields_per_s = 0\nexposure_ms = -1\n"
           "controls = [\"Gain\"]\nrecording = \"recording.y4m\"\nat_end = \"end\"\n"));

  EXPECT_TRUE(told("source.device: "));
  EXPECT_TRUE(told("box.toml:4: source.format: "));
  EXPECT_TRUE(told("box.toml:5: source.fields: "));
  EXPECT_TRUE(told("box.toml:6: source.standard: "));
  EXPECT_TRUE(told("box.toml:7: source.fields_per_s: "));
  EXPECT_TRUE(told("box.toml:8: source.exposure_ms: "));
  EXPECT_TRUE(told("box.toml:9: source.controls: 'Gain', expected \"NAME = VALUE\""));
  EXPECT_TRUE(told("box.toml:10: source.recording: of another kind of source"));
  EXPECT_TRUE(told("box.toml:11: source.at_end: of another kind of source"));
  EXPECT_EQ(messages_.size(), 9U);
}

TEST_F(CameraSettingsTest, APlayedSourceHasNoKeysOfACamera) {
  EXPECT_FALSE(load(std::string(kSource) + "device = \"serial:12\"\n"));

  EXPECT_TRUE(told("source.device: of another kind of source, expected it left out"));
}

constexpr const char* kGigeCamera =
    "[source]\nkind = \"aravis\"\ndevice = \"address:192.168.1.20\"\n";

TEST_F(CameraSettingsTest, AGigeCameraNeedsItsAddressAlone) {
  ASSERT_TRUE(load(kGigeCamera)) << messages_.front();

  EXPECT_EQ(box_->source.kind, SourceKind::kAravis);
  const drivers::AravisSettings& camera = box_->source.aravis;
  EXPECT_EQ(camera.device, "address:192.168.1.20");
  EXPECT_EQ(camera.binning, 1);
  EXPECT_FALSE(camera.gain);
  EXPECT_EQ(camera.packet_bytes, 0) << "negotiated";
  EXPECT_FALSE(camera.resend);
  EXPECT_EQ(camera.width_px, box_->told().camera.width_px) << "of the session";
  EXPECT_EQ(camera.height_px, box_->told().camera.height_px);
  EXPECT_EQ(camera.scan, box_->told().camera.scan);
  EXPECT_EQ(camera.calibrated.serial, "") << "the calibration names none";
}

TEST_F(CameraSettingsTest, EveryKeyOfAGigeCameraIsRead) {
  ASSERT_TRUE(
      load("[source]\nkind = \"aravis\"\ndevice = \"serial:A-12\"\n"
           "format = \"Mono12Packed\"\nfields_per_s = 50\nexposure_ms = 2.5\n"
           "left_px = 8\ntop_px = 16\nbinning = 2\ngain = 3.5\ntrigger = \"Line1\"\n"
           "packet_bytes = 1400\nresend = true\nreadout_ms = 8.5\n"
           "[camera_quality]\nid = \"c1\"\nserial = \"A-12\"\n"
           "[lamp]\nkind = \"pwm\"\nchip = \"fe20c000.pwm\"\nchannel = 1\n"))
      << messages_.front();

  const drivers::AravisSettings& camera = box_->source.aravis;
  EXPECT_EQ(camera.device, "serial:A-12");
  EXPECT_EQ(camera.format, "Mono12Packed");
  EXPECT_EQ(camera.fields_per_s, 50.0);
  EXPECT_EQ(camera.exposure_ms, 2.5);
  EXPECT_EQ(camera.left_px, 8);
  EXPECT_EQ(camera.top_px, 16);
  EXPECT_EQ(camera.binning, 2);
  EXPECT_EQ(camera.gain, 3.5);
  EXPECT_EQ(camera.trigger, "Line1");
  EXPECT_EQ(camera.packet_bytes, 1400);
  EXPECT_TRUE(camera.resend);
  EXPECT_EQ(camera.readout_ms, 8.5);
  EXPECT_EQ(camera.calibrated.serial, "A-12") << "of the calibration";
}

TEST_F(CameraSettingsTest, WhatReceivesGoesBeforeTheTracking) {
  ASSERT_TRUE(load(kGigeCamera));
  EXPECT_EQ(box_->source.aravis.priority, 51) << "the default's";
  ASSERT_TRUE(load(std::string(kGigeCamera) + "[realtime]\npriority = 99\n"));
  EXPECT_EQ(box_->source.aravis.priority, 99);
  ASSERT_TRUE(load(std::string(kGigeCamera) + "[realtime]\npriority = 0\n"));
  EXPECT_EQ(box_->source.aravis.priority, 0) << "like every other";
}

TEST_F(CameraSettingsTest, MistakesOfAGigeCameraAreTold) {
  EXPECT_FALSE(
      load("[source]\nkind = \"aravis\"\ndevice = \"address:camera7\"\nformat = \"BayerRG8\"\n"
           "left_px = -1\nbinning = 0\ngain = -1\ntrigger = \"Line1\"\npacket_bytes = 100\n"
           "readout_ms = 0\ninput = \"S-Video\"\nat_end = \"end\"\n"));

  EXPECT_TRUE(told("box.toml:4: source.device: 'address:camera7', expected address:FOUR.NUMBERS"));
  EXPECT_TRUE(told("box.toml:5: source.format: "));
  EXPECT_TRUE(told("box.toml:6: source.left_px: "));
  EXPECT_TRUE(told("box.toml:7: source.binning: "));
  EXPECT_TRUE(told("box.toml:8: source.gain: "));
  EXPECT_TRUE(told("box.toml:9: source.trigger: a rate that nobody says"));
  EXPECT_TRUE(told("box.toml:10: source.packet_bytes: "));
  EXPECT_TRUE(told("box.toml:11: source.readout_ms: "));
  EXPECT_TRUE(told("box.toml:12: source.input: of another kind of source"));
  EXPECT_TRUE(told("box.toml:13: source.at_end: of another kind of source"));
  EXPECT_EQ(messages_.size(), 10U);
}

TEST_F(CameraSettingsTest, OneKindOfCameraHasNotTheKeysOfTheOther) {
  EXPECT_FALSE(load(std::string(kCamera) + "packet_bytes = 1400\n"));
  EXPECT_TRUE(told("source.packet_bytes: of another kind of source, expected it left out"));
  EXPECT_FALSE(load(std::string(kSource) + "binning = 2\n"));
  EXPECT_TRUE(told("source.binning: of another kind of source, expected it left out"));
}

}  // namespace
}  // namespace tubesight::board
