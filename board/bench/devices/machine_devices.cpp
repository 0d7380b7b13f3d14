#include "board/bench/devices/machine_devices.h"

#include <cstddef>

namespace tubesight::board {
namespace {

std::string list_of(const std::vector<std::string>& entries) {
  std::string text;
  for (const std::string& entry : entries) {
    text += (text.empty() ? "" : ", ") + entry;
  }
  return text;
}

/// What binds a calibration to a camera, as it is written into `[camera_quality]`.
std::string calibration_text(const std::string& serial, const std::string& model) {
  return "      calibration: " + (serial.empty() ? "" : "serial = \"" + serial + "\", ") +
         "model = \"" + model + "\"\n";
}

}  // namespace

std::string cameras_text(const std::vector<drivers::v4l2::CameraInfo>& cameras) {
  if (cameras.empty()) {
    return "no cameras\n";
  }
  std::string text = "cameras, by the device to write into [source] of kind \"v4l2\":\n";
  for (const drivers::v4l2::CameraInfo& camera : cameras) {
    const std::string name = camera.name();
    text += "  " + name + "\n      " + camera.node;
    if (!camera.refused.empty()) {
      text += ", cannot be opened: " + camera.refused + "\n";
      continue;
    }
    text += ", " + camera.card + ", driver " + camera.driver + ", bus:" + camera.bus + "\n";
    text += camera.taken ? "      busy: another program takes its pictures\n" : "";
    for (const std::string& path : {camera.by_path, camera.by_id}) {
      text += path.empty() || path == name ? "" : "      also " + path + "\n";
    }
    text += camera.serial.empty() ? "      says no serial number\n" : "";
    text += camera.alone || camera.serial.empty()
                ? ""
                : "      not named by its serial number, which another one has, too\n";
    text += calibration_text(camera.serial, camera.driver + " " + camera.card);
    text += camera.inputs.empty() ? "" : "      inputs: " + list_of(camera.inputs) + "\n";
    text += camera.standards.empty()
                ? ""
                : "      standards: " + list_of(camera.standards) +
                      (camera.standard.empty() ? "" : "; set to " + camera.standard) + "\n";
    for (const std::string& format : camera.formats) {
      text += "      " + format + "\n";
    }
    text += camera.controls.empty() ? "" : "      controls: " + list_of(camera.controls) + "\n";
  }
  return text;
}

std::string network_cameras_text(const std::vector<drivers::aravis::CameraInfo>& cameras) {
  if (cameras.empty()) {
    return "no network cameras\n";
  }
  std::string text = "network cameras, by the device to write into [source] of kind \"aravis\":\n";
  for (const drivers::aravis::CameraInfo& camera : cameras) {
    // What is plugged into USB has no address of a network.
    const bool of_network = camera.protocol == "GigEVision";
    const std::string serial = camera.serial.empty() ? "" : "serial:" + camera.serial;
    text += "  " + (of_network ? "address:" + camera.address : serial) + "\n      " +
            camera.maker_and_model + ", " + camera.protocol + "\n";
    text += of_network && !serial.empty() ? "      also " + serial + "\n" : "";
    text += serial.empty() ? "      says no serial number\n" : "";
    text += calibration_text(camera.serial, camera.maker_and_model);
  }
  return text;
}

std::string gpio_text(const std::vector<drivers::GpioChip>& chips) {
  if (chips.empty()) {
    return "no GPIO chips\n";
  }
  std::string text = "GPIO chips, by the chip to write into [lamp]:\n";
  for (const drivers::GpioChip& chip : chips) {
    std::vector<std::string> free;
    std::vector<std::string> used;
    for (std::size_t i = 0; i < chip.lines.size(); ++i) {
      const drivers::GpioChip::Line& line = chip.lines[i];
      const std::string told =
          std::to_string(i) + (line.name.empty() ? "" : " (" + line.name + ")");
      (line.user.empty() ? free : used)
          .push_back(told + (line.user.empty() ? "" : " by " + line.user));
    }
    text += "  " + chip.label + "\n      " + chip.name + ", " + std::to_string(chip.lines.size()) +
            " lines\n";
    text += free.empty() ? "" : "      free: " + list_of(free) + "\n";
    text += used.empty() ? "" : "      used: " + list_of(used) + "\n";
  }
  return text;
}

std::string pwm_text(const std::vector<drivers::PwmChip>& chips) {
  if (chips.empty()) {
    return "no PWM chips\n";
  }
  std::string text = "PWM chips, by the chip to write into [lamp]:\n";
  for (const drivers::PwmChip& chip : chips) {
    text += "  " + (chip.device.empty() ? chip.name : chip.device) + "\n      " + chip.name + ", " +
            std::to_string(chip.channels) + (chip.channels == 1 ? " channel\n" : " channels\n");
  }
  return text;
}

}  // namespace tubesight::board
