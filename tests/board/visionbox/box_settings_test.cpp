#include "board/visionbox/box_settings.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/board/visionbox/box_settings_bench.h"

namespace tubesight::board {
namespace {

TEST_F(BoxSettingsTest, LittleIsEnough) {
  ASSERT_TRUE(load(kSource)) << messages_.front();

  EXPECT_EQ(box_->source.recording, folder_.path("recording.y4m"));
  EXPECT_TRUE(box_->source.loop);
  EXPECT_FALSE(box_->source.script);
  EXPECT_EQ(box_->control_socket, "");
  EXPECT_EQ(box_->real_time.priority, 50);
  EXPECT_TRUE(box_->real_time.lock_memory);
  EXPECT_EQ(box_->real_time.deadline_ms, 10.0);
  EXPECT_EQ(box_->link.kind, LinkKind::kNone);
  EXPECT_EQ(box_->session.settings.start.tubes.size(), 3);
}

TEST_F(BoxSettingsTest, EveryKeyIsRead) {
  ASSERT_TRUE(load(std::string(kSource) +
                   "at_end = \"end\"\nscript = true\n[control]\nsocket = \"/run/box\"\n"
                   "[realtime]\npriority = 0\nlock_memory = false\ndeadline_ms = 3\n"
                   "[link]\nkind = \"none\"\n"))
      << messages_.front();

  EXPECT_FALSE(box_->source.loop);
  EXPECT_TRUE(box_->source.script);
  EXPECT_EQ(box_->control_socket, "/run/box");
  EXPECT_EQ(box_->real_time.priority, 0);
  EXPECT_FALSE(box_->real_time.lock_memory);
  EXPECT_EQ(box_->real_time.deadline_ms, 3.0);
}

TEST_F(BoxSettingsTest, WhatIsRecordedIsRead) {
  ASSERT_TRUE(load(kSource));
  EXPECT_FALSE(box_->record.wanted());
  ASSERT_TRUE(load(std::string(kSource) + "[record]\nfolder = \"kept\"\n")) << messages_.front();
  EXPECT_EQ(box_->record.folder, folder_.path("kept"));
  EXPECT_EQ(box_->record.recorder.memory_mb, 64);
  EXPECT_TRUE(box_->record.recorder.on_disagreement && box_->record.recorder.on_track_lost);

  ASSERT_TRUE(load(std::string(kSource) +
                   "[record]\nfolder = \"/var\"\nmemory_mb = 32\ndisk_mb = 40\n"
                   "fields_after = 5\non_disagreement = false\non_track_lost = false\n"))
      << messages_.front();
  EXPECT_EQ(box_->record.folder, "/var");
  EXPECT_EQ(box_->record.recorder.memory_mb, 32);
  EXPECT_EQ(box_->record.disk_mb, 40);
  EXPECT_EQ(box_->record.recorder.fields_after, 5);
  EXPECT_FALSE(box_->record.recorder.on_disagreement || box_->record.recorder.on_track_lost);
}

TEST_F(BoxSettingsTest, ARecorderMustHoldItsFields) {
  const std::string record = std::string(kSource) + "[record]\n";
  EXPECT_FALSE(load(record + "memory_mb = 32\n"));
  EXPECT_TRUE(told("record.folder: missing"));
  EXPECT_FALSE(load(record + "folder = \"\"\n"));
  EXPECT_TRUE(told("box.toml:6: record.folder: '', expected the path of a folder"));
  EXPECT_FALSE(load(record + "folder = \"box.toml\"\n"));
  EXPECT_TRUE(told("box.toml:6: record.folder: '" + folder_.path("box.toml") +
                   "' is no folder, expected one, or none yet"));
  EXPECT_TRUE(load(record + "folder = \".\"\n")) << messages_.front();
  EXPECT_FALSE(load(record + "folder = \"x\"\nmemory_mb = 64\ndisk_mb = 63\n"));
  EXPECT_TRUE(told("record.disk_mb: 63, expected room for a recording of memory_mb = 64"));
  EXPECT_FALSE(load(record + "folder = \"x\"\nmemory_mb = 8\n"));
  EXPECT_TRUE(told("box.toml:5: record.memory_mb: 8, expected at least ")) << messages_.front();
  EXPECT_FALSE(load(record + "folder = \"x\"\nfields_after = 5000\n"));
  EXPECT_TRUE(told("record.fields_after: 5000, expected at most ")) << messages_.front();
}

TEST_F(BoxSettingsTest, EveryMistakeIsToldAtOnceWithItsLine) {
  EXPECT_FALSE(
      load("[source]\nkind = \"camera\"\nat_end = \"stop\"\nscript = 1\n"
           "recording = \"gone.y4m\"\nspeed = 2\n"
           "[control]\nsocket = \"" +
           std::string(200, 'x') +
           "\"\n"
           "[realtime]\npriority = 100\nlock_memory = \"yes\"\ndeadline_ms = 0\n"
           "[link]\nkind = \"pigeon\"\n[recorder]\n"));

  EXPECT_TRUE(told("box.toml:3: source.kind: "));
  EXPECT_TRUE(told("box.toml:4: source.at_end: "));
  EXPECT_TRUE(told("box.toml:5: source.script: "));
  EXPECT_TRUE(told("box.toml:6: source.recording: there is no file '" + folder_.path("gone.y4m")));
  EXPECT_TRUE(told("box.toml:7: source.speed: unknown key"));
  EXPECT_TRUE(told("box.toml:9: control.socket: "));
  EXPECT_TRUE(told("box.toml:11: realtime.priority: 100"));
  EXPECT_TRUE(told("box.toml:12: realtime.lock_memory: "));
  EXPECT_TRUE(told("box.toml:13: realtime.deadline_ms: 0"));
  EXPECT_TRUE(told("box.toml:15: link.kind: the text 'pigeon', expected \"none\" or \"modbus\""));
  EXPECT_TRUE(told("box.toml:16: [recorder]: unknown table"));
  EXPECT_EQ(messages_.size(), 11U);
}

TEST_F(BoxSettingsTest, ALampOnPwmIsRead) {
  ASSERT_TRUE(load(std::string(kCamera) +
                   "[lamp]\nkind = \"pwm\"\nchip = \"fe20c000.pwm\"\n"
                   "channel = 1\nfrequency_hz = 20000\ninverted = true\nsoft_ms = 0\n"
                   "full_for_s = 60\nrest_permille = 700\nsilent_after_s = 300\n"
                   "silent_permille = 100\n"
                   "[link]\nkind = \"modbus\"\ndevice = \"/dev/ttyS9\"\n"))
      << messages_.front();

  EXPECT_EQ(box_->lamp.kind, LampKind::kPwm);
  EXPECT_EQ(box_->lamp.pwm.chip, "fe20c000.pwm");
  EXPECT_EQ(box_->lamp.pwm.channel, 1);
  EXPECT_EQ(box_->lamp.pwm.frequency_hz, 20'000);
  EXPECT_TRUE(box_->lamp.pwm.inverted);
  EXPECT_EQ(box_->lamp.care.soft, std::chrono::milliseconds(0));
  EXPECT_EQ(box_->lamp.care.full_for, std::chrono::seconds(60));
  EXPECT_EQ(box_->lamp.care.rest_permille, 700);
  EXPECT_EQ(box_->lamp.silent_link.after, std::chrono::seconds(300));
  EXPECT_EQ(box_->lamp.silent_link.most_permille, 100);
}

TEST_F(BoxSettingsTest, ALampOnGpioIsRead) {
  ASSERT_TRUE(load(std::string(kCamera) +
                   "[lamp]\nkind = \"gpio\"\nchip = \"pinctrl\"\n"
                   "lines = [\"18\"]\nactive_low = true\nfrequency_hz = 2000\npriority = 0\n"))
      << messages_.front();
  EXPECT_EQ(box_->lamp.kind, LampKind::kGpio);
  EXPECT_EQ(box_->lamp.gpio.bank.chip, "pinctrl");
  EXPECT_EQ(box_->lamp.gpio.bank.lines, (std::vector<std::string>{"18"}));
  EXPECT_TRUE(box_->lamp.gpio.bank.active_low);
  EXPECT_EQ(box_->lamp.gpio.frequency_hz, 2000);
  EXPECT_EQ(box_->lamp.gpio.priority, 0);
  EXPECT_EQ(box_->lamp.care.soft, std::chrono::milliseconds(500));

  EXPECT_TRUE(load(std::string(kCamera) + "[lamp]\nkind = \"gpio\"\nchip = \"pinctrl\"\n"
                                          "lines = [\"LAMP1\", \"LAMP2\"]\n"));
}

TEST_F(BoxSettingsTest, ALampIsRuledByThePictureAsSet) {
  const std::string pwm = "[lamp]\nkind = \"pwm\"\nchip = \"fe20c000.pwm\"\nchannel = 1\n";
  ASSERT_TRUE(load(std::string(kCamera) + pwm)) << messages_.front();
  EXPECT_TRUE(box_->lamp.automatic && box_->lamp.pattern);
  ASSERT_TRUE(load(std::string(kCamera) + pwm + "automatic = false\npattern = false\n"));
  EXPECT_FALSE(box_->lamp.automatic || box_->lamp.pattern);
  const std::string gpio = "[lamp]\nkind = \"gpio\"\nchip = \"pinctrl\"\n";
  ASSERT_TRUE(load(std::string(kCamera) + gpio + "lines = [\"18\"]\n"));
  EXPECT_FALSE(box_->lamp.automatic || box_->lamp.pattern);
  EXPECT_FALSE(load(std::string(kCamera) + gpio + "lines = [\"1\", \"2\"]\npattern = true\n"));
  EXPECT_TRUE(told("lamp.pattern: of a lamp without steps, expected it left out"));
  EXPECT_FALSE(load(std::string(kSource) + "[lamp]\nkind = \"none\"\npattern = true\n"));
  EXPECT_TRUE(told("lamp.pattern: of a lamp that the box dims, expected it left out"));
}

// For a program that is to make the lamp dark whatever else somebody has spoilt.
TEST_F(BoxSettingsTest, WhichLampItIsIsKnownWhateverElseIsWrong) {
  const std::string pwm = "[lamp]\nkind = \"pwm\"\nchip = \"fe20c000.pwm\"\nchannel = 1\n";
  ASSERT_TRUE(load(std::string(kCamera) + pwm));
  EXPECT_TRUE(box_->lamp_sound);
  for (const char* more : {"soft_ms = -1\n", "full_for_s = 60\n", "pattern = 7\n",
                           "silent_after_s = 9\nsilent_permille = 0\n"}) {
    EXPECT_FALSE(load(std::string(kCamera) + pwm + more)) << more;
    EXPECT_TRUE(box_->lamp_sound) << more;
  }
  for (const char* more : {"inverted = 1\n", "invertd = true\n", "frequency_hz = 1\n"}) {
    EXPECT_FALSE(load(std::string(kCamera) + pwm + more)) << more;
    EXPECT_FALSE(box_->lamp_sound) << more;
  }
  EXPECT_FALSE(load("[source]\nkind = \"v4l3\"\n" + pwm));
  EXPECT_EQ(box_->lamp.kind, LampKind::kPwm);
  EXPECT_TRUE(box_->lamp_sound);
  EXPECT_FALSE(told("lamp.")) << "nothing is wrong with it";
  EXPECT_FALSE(load(pwm));
  EXPECT_TRUE(box_->lamp_sound) << "without a source";
  EXPECT_FALSE(load(std::string(kCamera) + "[lamp]\nkind = \"none\"\nsoft_ms = -1\n"));
  EXPECT_FALSE(box_->lamp_sound);
}

// A short shutter, in which the number of pulses is no whole one.
TEST_F(BoxSettingsTest, PulsesThatBeatWithTheExposureAreTold) {
  const auto box = [](const std::string& exposure, const std::string& lamp) {
    std::string text(kCamera);
    const std::string source = "[source]\n";
    text.insert(text.find(source) + source.size(), "exposure_ms = " + exposure + "\n");
    return text + "[lamp]\n" + lamp;
  };
  const std::string pwm = "kind = \"pwm\"\nchip = \"fe20c000.pwm\"\nchannel = 1\n";
  EXPECT_TRUE(load(box("16.7", pwm))) << messages_.front();
  EXPECT_TRUE(load(box("1.0", pwm))) << "two pulses, whatever the instant";
  EXPECT_FALSE(load(box("1.25", pwm)));
  EXPECT_TRUE(
      told("lamp.frequency_hz: 2000 pulses a second beat with the exposure by 40 % of the "
           "light, expected 16000 or more, or pattern = false"));
  EXPECT_TRUE(load(box("1.25", pwm + "frequency_hz = 16000\n"))) << messages_.front();
  EXPECT_TRUE(load(box("1.25", pwm + "pattern = false\n"))) << messages_.front();

  const std::string gpio = "kind = \"gpio\"\nchip = \"pinctrl\"\nlines = [\"18\"]\n";
  EXPECT_TRUE(load(box("1.25", gpio))) << "no pattern";
  EXPECT_FALSE(load(box("1.25", gpio + "pattern = true\n")));
  EXPECT_TRUE(
      told("lamp.frequency_hz: 1000 pulses a second beat with the exposure by 40 % of the "
           "light, expected pattern = false"));
}

// A field of an analog camera is exposed for as long as its standard says.
TEST_F(BoxSettingsTest, PulsesThatBeatWithAFieldOfTheStandardAreTold) {
  const auto box = [](const std::string& standard, const std::string& frequency) {
    std::string text(kCamera);
    const std::string source = "[source]\n";
    text.insert(text.find(source) + source.size(), "standard = \"" + standard + "\"\n");
    return text + "[lamp]\nkind = \"pwm\"\nchip = \"fe20c000.pwm\"\nchannel = 1\nfrequency_hz = " +
           frequency + "\n";
  };
  EXPECT_TRUE(load(box("PAL", "100"))) << "two pulses";
  EXPECT_FALSE(load(box("NTSC", "100")));
  EXPECT_TRUE(
      told("lamp.frequency_hz: 100 pulses a second beat with the exposure by 40 % of the light, "
           "expected 1199 or more, or pattern = false"))
      << messages_.front();
  EXPECT_FALSE(load(box("PAL", "120")));
  EXPECT_TRUE(load(box("NTSC", "120"))) << messages_.front();
}

TEST_F(BoxSettingsTest, BeatIsThatOfTheWave) {
  // As lamp_beat_study draws it at half light: 100 pulses in 4 ms are 0.4 of one, 2 * 0.4 / 0.4.
  EXPECT_NEAR(beat_of_pulses(100.0, 4.0), 2.0, 1e-9);
  EXPECT_NEAR(beat_of_pulses(1000.0, 4.0), 0.0, 1e-9);
  EXPECT_NEAR(beat_of_pulses(119.7, 16.0), 2.0 * (2.0 - 119.7 * 0.016) / (119.7 * 0.016), 1e-9);
}

TEST_F(BoxSettingsTest, MistakesOfALampAreTold) {
  EXPECT_FALSE(load(std::string(kCamera) +
                    "[lamp]\nkind = \"pwm\"\nlines = [\"1\"]\n"
                    "rest_permille = 5\nfrequency_hz = 1\nsilent_permille = 7\n"));
  EXPECT_TRUE(told("lamp.chip: "));
  EXPECT_TRUE(told("lamp.channel: "));
  EXPECT_TRUE(told("box.toml:7: lamp.lines: of another kind of lamp, expected it left out"));
  EXPECT_TRUE(told("box.toml:8: lamp.rest_permille: of a time at full power, which needs "));
  EXPECT_TRUE(told("box.toml:9: lamp.frequency_hz: 1"));
  EXPECT_TRUE(told("box.toml:10: lamp.silent_permille: of a silent link, which needs "));
  EXPECT_EQ(messages_.size(), 6U);

  EXPECT_FALSE(load(std::string(kCamera) + "[lamp]\nkind = \"gpio\"\nchip = \"pinctrl\"\n"));
  EXPECT_TRUE(told("lamp.lines: missing, expected 1 to 8 lines"));

  EXPECT_FALSE(load(std::string(kCamera) + "[lamp]\nkind = \"gpio\"\nchip = \"pinctrl\"\n"
                                           "lines = [\"1\", \"2\"]\npriority = 5\n"));
  EXPECT_TRUE(told("lamp.priority: of pulses, which a single line has, expected it left out"));

  EXPECT_FALSE(load(std::string(kCamera) + "[lamp]\nkind = \"gpio\"\nchip = \"pinctrl\"\n"
                                           "lines = [\"1\"]\nfull_for_s = 60\n"
                                           "rest_permille = 1000\nsilent_after_s = 5\n"
                                           "silent_permille = 0\n"));
  EXPECT_TRUE(told("lamp.rest_permille: 1000")) << "nothing would be spared";
  EXPECT_TRUE(told("lamp.silent_after_s: of a robot's link, which is \"none\""));

  EXPECT_FALSE(load(std::string(kSource) + "[lamp]\nkind = \"gpio\"\nchip = \"pinctrl\"\n"
                                           "lines = [\"1\"]\n"));
  EXPECT_TRUE(
      told("lamp.kind: gpio, expected \"none\": a source that is played has its own light"));
  EXPECT_EQ(messages_.size(), 1U);
}

TEST_F(BoxSettingsTest, ALinkHasModbussOwnDefaults) {
  ASSERT_TRUE(load(std::string(kSource) + "[link]\nkind = \"modbus\"\ndevice = \"/dev/ttyS9\"\n"))
      << messages_.front();

  EXPECT_EQ(box_->link.kind, LinkKind::kModbus);
  const drivers::ModbusSettings& modbus = box_->link.modbus;
  EXPECT_EQ(modbus.serial.line.device, "/dev/ttyS9");
  EXPECT_EQ(modbus.serial.line.baud, 19'200);
  EXPECT_EQ(modbus.serial.line.parity, drivers::SerialParity::kEven);
  EXPECT_EQ(modbus.serial.line.stop_bits, 1);
  EXPECT_FALSE(modbus.serial.line.rs485);
  EXPECT_EQ(modbus.serial.unit, 1);
  EXPECT_EQ(modbus.word_order, drivers::WordOrder::kHighFirst);
  EXPECT_LT(modbus.tcp_port, 0) << "off";
}

TEST_F(BoxSettingsTest, EveryKeyOfALinkIsRead) {
  ASSERT_TRUE(load(std::string(kSource) +
                   "[link]\nkind = \"modbus\"\ndevice = \"/dev/ttyS9\"\nbaud = 115200\n"
                   "parity = \"none\"\nstop_bits = 2\nrs485 = true\nunit = 247\n"
                   "word_order = \"low-first\"\ntcp_address = \"0.0.0.0\"\ntcp_port = 502\n"))
      << messages_.front();

  const drivers::ModbusSettings& modbus = box_->link.modbus;
  EXPECT_EQ(modbus.serial.line.baud, 115'200);
  EXPECT_EQ(modbus.serial.line.parity, drivers::SerialParity::kNone);
  EXPECT_EQ(modbus.serial.line.stop_bits, 2);
  EXPECT_TRUE(modbus.serial.line.rs485);
  EXPECT_EQ(modbus.serial.unit, 247);
  EXPECT_EQ(modbus.word_order, drivers::WordOrder::kLowFirst);
  EXPECT_EQ(modbus.tcp_address, "0.0.0.0");
  EXPECT_EQ(modbus.tcp_port, 502);
}

TEST_F(BoxSettingsTest, ALinesDeviceMayBeMissingButNotAFolderOrAFile) {
  const std::string link = std::string(kSource) + "[link]\nkind = \"modbus\"\ndevice = ";
  EXPECT_FALSE(load(link + "\"/dev\"\n"));
  EXPECT_TRUE(told("box.toml:7: link.device: '/dev' is a folder, expected a serial line"));
  EXPECT_FALSE(load(link + "\"/proc/version\"\n"));
  EXPECT_TRUE(told("link.device: '/proc/version' is a file, expected a serial line"));
  EXPECT_TRUE(load(link + "\"/dev/null\"\n")) << "whether it is one, opening tells";
  EXPECT_TRUE(load(link + "\"/dev/serial/by-id/not-yet\"\n"));
}

TEST_F(BoxSettingsTest, EveryMistakeOfALinkIsTold) {
  EXPECT_FALSE(load(std::string(kSource) +
                    "[link]\nkind = \"modbus\"\ndevice = \"ttyUSB0\"\nbaud = 19201\n"
                    "parity = \"mark\"\nstop_bits = 3\nrs485 = 1\nunit = 248\n"
                    "word_order = \"big\"\ntcp_address = \"localhost\"\ntcp_port = 0\n"
                    "speed = 1\n"));

  EXPECT_TRUE(told("box.toml:7: link.device: 'ttyUSB0', expected a path from the root"));
  EXPECT_TRUE(told("box.toml:8: link.baud: 19201, expected a usual rate"));
  EXPECT_TRUE(told("box.toml:9: link.parity: "));
  EXPECT_TRUE(told("box.toml:10: link.stop_bits: 3"));
  EXPECT_TRUE(told("box.toml:11: link.rs485: "));
  EXPECT_TRUE(told("box.toml:12: link.unit: 248"));
  EXPECT_TRUE(told("box.toml:13: link.word_order: "));
  EXPECT_TRUE(told("box.toml:14: link.tcp_address: 'localhost', expected four numbers"));
  EXPECT_TRUE(told("box.toml:15: link.tcp_port: 0"));
  EXPECT_TRUE(told("box.toml:16: link.speed: unknown key"));
  EXPECT_EQ(messages_.size(), 10U);
}

TEST_F(BoxSettingsTest, AModbusLinkNeedsALineAndKeysThatNobodyObeysAreMistakes) {
  EXPECT_FALSE(load(std::string(kSource) + "[link]\nkind = \"modbus\"\n"));
  EXPECT_TRUE(told("link.kind: modbus without a line, expected a device, a tcp_port or both"));
  EXPECT_EQ(messages_.size(), 1U);

  EXPECT_FALSE(
      load(std::string(kSource) + "[link]\nkind = \"modbus\"\ntcp_port = 1502\nbaud = 9600\n"));
  EXPECT_TRUE(told("link.baud: of a serial line, which needs a device"));

  EXPECT_FALSE(load(std::string(kSource) + "[link]\nkind = \"modbus\"\ndevice = \"/dev/ttyS9\"\n"
                                           "tcp_address = \"0.0.0.0\"\n"));
  EXPECT_TRUE(told("link.tcp_address: of TCP, which needs a tcp_port"));

  EXPECT_FALSE(load(std::string(kSource) + "[link]\nkind = \"none\"\nunit = 1\n"));
  EXPECT_TRUE(told("link.unit: of another kind of link, expected it left out"));
}

TEST_F(BoxSettingsTest, MistakesOfTheSessionAreToldWithThem) {
  folder_.write("box.toml", "[source]\nkind = \"replay\"\n[camera]\nwidth_px = 5\n");

  EXPECT_FALSE(load_box_settings(folder_.path("box.toml"), *box_, messages_));

  EXPECT_TRUE(told("source.recording: missing"));
  EXPECT_TRUE(told("camera.width_px: 5"));
  EXPECT_TRUE(told("tubesheet: the table is missing"));
}

TEST_F(BoxSettingsTest, ASimulationBringsItsSession) {
  folder_.write("box.toml", "[source]\nkind = \"simulated\"\nscenario = \"" +
                                std::string(TUBESIGHT_SOURCE_DIR) +
                                "/docs/examples/steam-generator.toml\"\n");

  ASSERT_TRUE(load_box_settings(folder_.path("box.toml"), *box_, messages_)) << messages_.front();

  EXPECT_EQ(box_->source.kind, SourceKind::kSimulated);
  EXPECT_EQ(box_->told().camera.width_px, 635);
  EXPECT_EQ(box_->told().start.tubes.size(), 3) << "clicks made of the truth";
}

TEST_F(BoxSettingsTest, MistakesOfAScenarioAreToldWithThoseOfTheBox) {
  folder_.write("scenario.toml", "[camera]\nwidth_px = 5\n");
  folder_.write("box.toml",
                "[source]\nkind = \"simulated\"\nscenario = \"scenario.toml\"\nspeed = 1\n"
                "recording = \"recording.y4m\"\n[motion]\n");

  EXPECT_FALSE(load_box_settings(folder_.path("box.toml"), *box_, messages_));

  EXPECT_TRUE(told("box.toml:4: source.speed: unknown key"));
  EXPECT_TRUE(told("box.toml:5: source.recording: of another kind of source"));
  EXPECT_TRUE(told("box.toml:6: motion: a simulated source has the tables of its scenario"));
  EXPECT_TRUE(told("scenario.toml:2: camera.width_px: 5"));
  EXPECT_TRUE(told("scenario.toml: tubesheet: the table is missing") ||
              told("tubesheet: the table is missing"));
}

TEST_F(BoxSettingsTest, WithoutASourceThereIsNoBox) {
  EXPECT_FALSE(load(""));

  EXPECT_TRUE(told("source: the table is missing"));
}

}  // namespace
}  // namespace tubesight::board
