#include "drivers/aravis/camera_setup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace tubesight::drivers::aravis {
namespace {

using core::Error;
using core::FieldTime;
using core::Result;
using core::Unexpected;

/// Cameras set times in steps of their own, some as long as a line.
constexpr double kKept = 0.05;

/// A number for a person: without noughts behind it.
std::string text_of(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::string text_of(const Region& region) {
  return std::to_string(region.width_px) + " x " + std::to_string(region.height_px) + " at " +
         std::to_string(region.left_px) + ", " + std::to_string(region.top_px);
}

FieldTime to_time(double seconds) { return FieldTime{std::llround(seconds * 1e9)}; }

/// One camera being set up: says each refusal in one line.
class Setup {
 public:
  Setup(Device& device, const AravisSettings& settings, AgreedPicture& agreed, std::string& message)
      : device_(&device), settings_(&settings), agreed_(&agreed), message_(&message) {}

  Result<void> picture();
  Result<void> format();
  Result<void> exposure();
  Result<void> rate();
  Result<void> packets(bool safe);
  Result<void> payload();

 private:
  Result<void> refuse(Error error, const std::string& what) {
    *message_ = what;
    return Unexpected(error);
  }
  Result<void> set(Quantity quantity, const char* name, double value);
  void readout();

  Device* device_;
  const AravisSettings* settings_;
  AgreedPicture* agreed_;
  std::string* message_;
  std::string why_;
};

Result<void> Setup::picture() {
  if (!device_->set_binning(settings_->binning, why_)) {
    if (!why_.empty()) {
      return refuse(Error::kIo, "binning " + std::to_string(settings_->binning) + ": " + why_);
    }
    if (settings_->binning != 1) {
      return refuse(Error::kUnsupported,
                    "has no binning, expected " + std::to_string(settings_->binning));
    }
  }
  const Region wanted{settings_->left_px, settings_->top_px, settings_->width_px,
                      settings_->height_px};
  Region got;
  const bool set = device_->set_region(wanted, why_) && device_->region(got, why_);
  if (!set || got != wanted) {
    const Region sensor = device_->sensor();
    return refuse(Error::kUnsupported,
                  (set ? "gives " + text_of(got) : "refuses its region (" + why_ + ")") +
                      " of its " + std::to_string(sensor.width_px) + " x " +
                      std::to_string(sensor.height_px) + ", expected " + text_of(wanted));
  }
  // Whoever had it before may have left it mirrored, thinned out, or showing no picture at all.
  std::string altered;
  for (const std::string& alteration : device_->alterations()) {
    altered += (altered.empty() ? "" : ", ") + alteration;
  }
  if (!altered.empty()) {
    return refuse(Error::kUnsupported, "gives no plain pictures: " + altered + ", expected off");
  }
  agreed_->width_px = wanted.width_px;
  agreed_->height_px = wanted.height_px;
  agreed_->pair = settings_->scan != core::Scan::kProgressive;
  return {};
}

Result<void> Setup::format() {
  const std::vector<std::string> offered = device_->formats();
  std::string all;
  for (const std::string& name : offered) {
    all += (all.empty() ? "" : ", ") + name;
  }
  std::string wanted = settings_->format;
  if (wanted.empty()) {
    for (const GreyFormat& format : kGreyFormats) {
      const bool whole = settings_->width_px % format.group_px == 0;
      if (whole && std::ranges::find(offered, format.name) != offered.end()) {
        wanted = format.name;
        break;
      }
    }
  }
  const auto known = grey_format_named(wanted);
  if (!known || std::ranges::find(offered, wanted) == offered.end()) {
    return refuse(Error::kUnsupported,
                  "offers " + (all.empty() ? "no format" : all) + ", expected " +
                      (wanted.empty() ? "Mono8 or another of grey values" : wanted));
  }
  if (settings_->width_px % known->group_px != 0) {
    return refuse(Error::kUnsupported, "lines of " + std::to_string(settings_->width_px) +
                                           " pixels, expected a multiple of " +
                                           std::to_string(known->group_px) + " with " + wanted);
  }
  if (!device_->set_format(wanted, why_)) {
    return refuse(Error::kIo, "format " + wanted + ": " + why_);
  }
  agreed_->format = *known;
  agreed_->bytes = static_cast<std::size_t>(known->line_bytes(settings_->width_px)) *
                   static_cast<std::size_t>(settings_->height_px);
  return {};
}

Result<void> Setup::set(Quantity quantity, const char* name, double value) {
  if (!device_->has(quantity)) {
    return refuse(Error::kUnsupported,
                  std::string("has no ") + name + " that can be set, expected " + text_of(value));
  }
  double got = 0.0;
  if (!device_->set(quantity, value, why_) || !device_->get(quantity, got, why_)) {
    Bounds bounds;
    const std::string range =
        device_->bounds(quantity, bounds)
            ? ", offers " + text_of(bounds.least) + " to " + text_of(bounds.most)
            : std::string();
    return refuse(Error::kUnsupported,
                  std::string(name) + " " + text_of(value) + ": " + why_ + range);
  }
  if (std::abs(got - value) > kKept * std::abs(value) + 1e-6) {
    return refuse(Error::kUnsupported, std::string("keeps ") + name + " " + text_of(got) +
                                           ", expected " + text_of(value));
  }
  return {};
}

Result<void> Setup::exposure() {
  device_->by_hand(Quantity::kExposure_us);
  device_->by_hand(Quantity::kGain);
  if (settings_->exposure_ms > 0.0) {
    TUBESIGHT_TRY(set(Quantity::kExposure_us, "exposure in us", settings_->exposure_ms * 1e3));
  }
  if (settings_->gain) {
    TUBESIGHT_TRY(set(Quantity::kGain, "gain", *settings_->gain));
  }
  double exposure_us = 0.0;
  if (device_->has(Quantity::kExposure_us) &&
      device_->get(Quantity::kExposure_us, exposure_us, why_) && exposure_us > 0.0) {
    agreed_->exposure = to_time(exposure_us * 1e-6);
  }
  return {};
}

Result<void> Setup::rate() {
  const double a_frame = agreed_->pair ? 2.0 : 1.0;
  double frames_per_s = settings_->fields_per_s / a_frame;
  if (!device_->set_trigger(settings_->trigger, why_)) {
    return refuse(Error::kUnsupported, settings_->trigger.empty()
                                           ? "does not go at its own rate: " + why_
                                           : "trigger '" + settings_->trigger + "': " + why_);
  }
  // A rate of its own would contradict the trigger's.
  if (settings_->trigger.empty()) {
    if (frames_per_s > 0.0 && device_->has(Quantity::kFrames_per_s)) {
      TUBESIGHT_TRY(set(Quantity::kFrames_per_s, "frames a second", frames_per_s));
    }
    double got = 0.0;
    if (device_->has(Quantity::kFrames_per_s) && device_->get(Quantity::kFrames_per_s, got, why_) &&
        got > 0.0) {
      frames_per_s = got;
    }
  }
  if (!(frames_per_s > 0.0)) {
    return refuse(Error::kUnsupported, "does not say its rate, expected fields_per_s to say it");
  }
  agreed_->span = to_time(1.0 / (frames_per_s * a_frame));
  if (agreed_->exposure <= FieldTime{0}) {
    agreed_->exposure = agreed_->span;
  }
  readout();
  return {};
}

/// Of one frame at a time a camera can take no more a second than it can read out and send. Of an
/// analogue camera behind a converter the readout lasts a field's time, and both fields come
/// together.
void Setup::readout() {
  Bounds bounds;
  if (settings_->readout_ms > 0.0) {
    agreed_->readout = to_time(settings_->readout_ms * 1e-3);
  } else if (agreed_->pair) {
    agreed_->readout = agreed_->span;
  } else {
    agreed_->readout = agreed_->span;
    if (device_->bounds(Quantity::kFrames_per_s, bounds) && bounds.most > 0.0) {
      agreed_->readout = std::min(agreed_->span, to_time(1.0 / bounds.most));
    }
  }
}

Result<void> Setup::packets(bool safe) {
  if (!device_->has_packets()) {
    return {};
  }
  if (settings_->packet_bytes == 0 && !safe) {
    // A camera that does not answer the question keeps the size that it has.
    static_cast<void>(device_->negotiate_packet_size(why_));
    agreed_->packet_bytes = device_->packet_size();
    return {};
  }
  const std::int32_t bytes = settings_->packet_bytes != 0 ? settings_->packet_bytes : kSafePacket;
  if (!device_->set_packet_size(bytes, why_)) {
    return refuse(Error::kIo, "packets of " + std::to_string(bytes) + " bytes: " + why_);
  }
  agreed_->packet_bytes = device_->packet_size();
  // Cameras have steps of their own; a larger one is what the settings keep off the network.
  if (agreed_->packet_bytes > bytes) {
    return refuse(Error::kUnsupported, "sends packets of " + std::to_string(agreed_->packet_bytes) +
                                           " bytes, expected " + std::to_string(bytes));
  }
  return {};
}

Result<void> Setup::payload() {
  const std::size_t payload = device_->payload();
  if (payload != 0 && payload < agreed_->bytes) {
    return refuse(Error::kUnsupported, "sends " + std::to_string(payload) +
                                           " bytes a picture, expected " +
                                           std::to_string(agreed_->bytes));
  }
  agreed_->buffer_bytes = std::max(payload, agreed_->bytes);
  return {};
}

}  // namespace

Result<void> set_up(Device& device, const AravisSettings& settings, bool safe_packets,
                    AgreedPicture& agreed, std::string& message) {
  Setup setup(device, settings, agreed, message);
  device.quieten();  // whoever had it before may have left it sending
  TUBESIGHT_TRY(setup.picture());
  TUBESIGHT_TRY(setup.format());
  TUBESIGHT_TRY(setup.exposure());
  TUBESIGHT_TRY(setup.rate());
  TUBESIGHT_TRY(setup.packets(safe_packets));
  return setup.payload();
}

}  // namespace tubesight::drivers::aravis
