#include "drivers/aravis/system_device.h"

#include "drivers/aravis/refusal.h"

namespace tubesight::drivers::aravis {
namespace {

std::string text_of(const char* text) { return text != nullptr ? text : ""; }

}  // namespace

SystemDevice::SystemDevice(const Functions& functions, ArvCamera* camera)
    : arv_(&functions), camera_(camera) {
  sem_init(&news_, 0, 0);
  // Sizes of packets are our business: the library's own choice may be more than the path takes.
  arv_->arv_camera_gv_set_packet_size_adjustment(camera_, ARV_GV_PACKET_SIZE_ADJUSTMENT_NEVER);
  control_lost_handler_ = arv_->g_signal_connect_data(
      arv_->arv_camera_get_device(camera_), "control-lost",
      reinterpret_cast<GCallback>(&SystemDevice::on_control_lost), this, nullptr, GConnectFlags{});
}

SystemDevice::~SystemDevice() {
  end(true);
  arv_->g_signal_handler_disconnect(arv_->arv_camera_get_device(camera_), control_lost_handler_);
  arv_->g_object_unref(camera_);
  sem_destroy(&news_);
}

std::string SystemDevice::serial() {
  Refusal refusal(*arv_);
  return text_of(arv_->arv_camera_get_device_serial_number(camera_, refusal.out()));
}

std::string SystemDevice::maker_and_model() {
  Refusal refusal(*arv_);
  const std::string maker = text_of(arv_->arv_camera_get_vendor_name(camera_, refusal.out()));
  return maker + " " + text_of(arv_->arv_camera_get_model_name(camera_, refusal.out()));
}

std::vector<std::string> SystemDevice::formats() {
  Refusal refusal(*arv_);
  guint number = 0;
  const char** const names =
      arv_->arv_camera_dup_available_pixel_formats_as_strings(camera_, &number, refusal.out());
  std::vector<std::string> formats;
  for (guint i = 0; names != nullptr && i < number; ++i) {
    formats.push_back(text_of(names[i]));
  }
  arv_->g_free(names);
  return formats;
}

bool SystemDevice::set_format(const std::string& name, std::string& why) {
  Refusal refusal(*arv_);
  arv_->arv_camera_set_pixel_format_from_string(camera_, name.c_str(), refusal.out());
  if (refusal.said(why)) {
    return false;
  }
  const std::string got =
      text_of(arv_->arv_camera_get_pixel_format_as_string(camera_, refusal.out()));
  why = "keeps " + got;
  return got == name;
}

bool SystemDevice::set_binning(std::int32_t pixels, std::string& why) {
  why.clear();
  Refusal refusal(*arv_);
  if (arv_->arv_camera_is_binning_available(camera_, refusal.out()) == FALSE || refusal.said()) {
    return false;
  }
  arv_->arv_camera_set_binning(camera_, pixels, pixels, refusal.out());
  if (refusal.said(why)) {
    return false;
  }
  gint across = 0;
  gint down = 0;
  arv_->arv_camera_get_binning(camera_, &across, &down, refusal.out());
  why = "keeps " + std::to_string(across) + " x " + std::to_string(down);
  return !refusal.said(why) && across == pixels && down == pixels;
}

bool SystemDevice::set_region(const Region& region, std::string& why) {
  Refusal refusal(*arv_);
  arv_->arv_camera_set_region(camera_, region.left_px, region.top_px, region.width_px,
                              region.height_px, refusal.out());
  return !refusal.said(why);
}

bool SystemDevice::region(Region& region, std::string& why) {
  Refusal refusal(*arv_);
  arv_->arv_camera_get_region(camera_, &region.left_px, &region.top_px, &region.width_px,
                              &region.height_px, refusal.out());
  return !refusal.said(why);
}

Region SystemDevice::sensor() {
  Refusal refusal(*arv_);
  Region sensor;
  arv_->arv_camera_get_sensor_size(camera_, &sensor.width_px, &sensor.height_px, refusal.out());
  return sensor;
}

// By the names of the GenICam Standard Features Naming Convention; TestImageSelector is that of
// its first versions.
std::vector<std::string> SystemDevice::alterations() {
  std::vector<std::string> found;
  Refusal refusal(*arv_);
  const auto has = [&](const char* name) {
    return arv_->arv_camera_is_feature_available(camera_, name, refusal.out()) != FALSE &&
           !refusal.said();
  };
  for (const char* const name : {"ReverseX", "ReverseY"}) {
    if (has(name) && arv_->arv_camera_get_boolean(camera_, name, refusal.out()) != FALSE) {
      found.push_back(std::string(name) + " is on");
    }
  }
  for (const char* const name : {"DecimationHorizontal", "DecimationVertical"}) {
    const gint64 pixels =
        has(name) ? arv_->arv_camera_get_integer(camera_, name, refusal.out()) : 1;
    if (pixels > 1) {
      found.push_back(std::string(name) + " is " + std::to_string(pixels));
    }
  }
  for (const char* const name : {"TestPattern", "TestImageSelector"}) {
    const std::string pattern =
        has(name) ? text_of(arv_->arv_camera_get_string(camera_, name, refusal.out())) : "";
    if (!pattern.empty() && pattern != "Off") {
      found.push_back(std::string(name) + " is " + pattern);
    }
  }
  return found;
}

bool SystemDevice::has(Quantity quantity) {
  Refusal refusal(*arv_);
  gboolean there = FALSE;
  switch (quantity) {
    case Quantity::kFrames_per_s:
      there = arv_->arv_camera_is_frame_rate_available(camera_, refusal.out());
      break;
    case Quantity::kExposure_us:
      there = arv_->arv_camera_is_exposure_time_available(camera_, refusal.out());
      break;
    case Quantity::kGain: there = arv_->arv_camera_is_gain_available(camera_, refusal.out()); break;
  }
  return there != FALSE && !refusal.said();
}

void SystemDevice::by_hand(Quantity quantity) {
  Refusal refusal(*arv_);
  if (quantity == Quantity::kExposure_us &&
      arv_->arv_camera_is_exposure_auto_available(camera_, refusal.out()) != FALSE) {
    arv_->arv_camera_set_exposure_time_auto(camera_, ARV_AUTO_OFF, refusal.out());
  }
  if (quantity == Quantity::kGain &&
      arv_->arv_camera_is_gain_auto_available(camera_, refusal.out()) != FALSE) {
    arv_->arv_camera_set_gain_auto(camera_, ARV_AUTO_OFF, refusal.out());
  }
}

bool SystemDevice::set(Quantity quantity, double value, std::string& why) {
  Refusal refusal(*arv_);
  switch (quantity) {
    case Quantity::kFrames_per_s:
      arv_->arv_camera_set_frame_rate(camera_, value, refusal.out());
      break;
    case Quantity::kExposure_us:
      arv_->arv_camera_set_exposure_time(camera_, value, refusal.out());
      break;
    case Quantity::kGain: arv_->arv_camera_set_gain(camera_, value, refusal.out()); break;
  }
  return !refusal.said(why);
}

bool SystemDevice::get(Quantity quantity, double& value, std::string& why) {
  Refusal refusal(*arv_);
  switch (quantity) {
    case Quantity::kFrames_per_s:
      value = arv_->arv_camera_get_frame_rate(camera_, refusal.out());
      break;
    case Quantity::kExposure_us:
      value = arv_->arv_camera_get_exposure_time(camera_, refusal.out());
      break;
    case Quantity::kGain: value = arv_->arv_camera_get_gain(camera_, refusal.out()); break;
  }
  return !refusal.said(why);
}

bool SystemDevice::bounds(Quantity quantity, Bounds& bounds) {
  Refusal refusal(*arv_);
  switch (quantity) {
    case Quantity::kFrames_per_s:
      arv_->arv_camera_get_frame_rate_bounds(camera_, &bounds.least, &bounds.most, refusal.out());
      break;
    case Quantity::kExposure_us:
      arv_->arv_camera_get_exposure_time_bounds(camera_, &bounds.least, &bounds.most,
                                                refusal.out());
      break;
    case Quantity::kGain:
      arv_->arv_camera_get_gain_bounds(camera_, &bounds.least, &bounds.most, refusal.out());
      break;
  }
  return !refusal.said();
}

bool SystemDevice::set_trigger(const std::string& line, std::string& why) {
  Refusal refusal(*arv_);
  if (line.empty()) {
    arv_->arv_camera_clear_triggers(camera_, refusal.out());
  } else {
    arv_->arv_camera_set_trigger(camera_, line.c_str(), refusal.out());
  }
  return !refusal.said(why);
}

bool SystemDevice::has_packets() { return arv_->arv_camera_is_gv_device(camera_) != FALSE; }

bool SystemDevice::set_packet_size(std::int32_t bytes, std::string& why) {
  Refusal refusal(*arv_);
  arv_->arv_camera_gv_set_packet_size(camera_, bytes, refusal.out());
  return !refusal.said(why);
}

bool SystemDevice::negotiate_packet_size(std::string& why) {
  Refusal refusal(*arv_);
  static_cast<void>(arv_->arv_camera_gv_auto_packet_size(camera_, refusal.out()));
  return !refusal.said(why);
}

std::int32_t SystemDevice::packet_size() {
  Refusal refusal(*arv_);
  return static_cast<std::int32_t>(arv_->arv_camera_gv_get_packet_size(camera_, refusal.out()));
}

std::size_t SystemDevice::payload() {
  Refusal refusal(*arv_);
  return arv_->arv_camera_get_payload(camera_, refusal.out());
}

void SystemDevice::quieten() {
  Refusal refusal(*arv_);
  arv_->arv_camera_stop_acquisition(camera_, refusal.out());
}

}  // namespace tubesight::drivers::aravis
