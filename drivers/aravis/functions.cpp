#include "drivers/aravis/functions.h"

#include <dlfcn.h>

namespace tubesight::drivers::aravis {
namespace {

/// Its version of the interface, which Debian 12 and 13 have.
constexpr const char* kLibrary = "libaravis-0.8.so.0";

/// Looks names up in a library and those that it stands on; remembers the first that is missing.
class Lookup {
 public:
  explicit Lookup(void* library) : library_(library) {}

  template <typename Function>
  void operator()(const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(library_, name));
    if (function == nullptr && missing_.empty()) {
      missing_ = name;
    }
  }

  [[nodiscard]] const std::string& missing() const { return missing_; }

 private:
  void* library_;
  std::string missing_;
};

void look_up_buffers_and_streams(Lookup& look_up, Functions& f) {
  look_up("arv_buffer_get_frame_id", f.arv_buffer_get_frame_id);
  look_up("arv_buffer_get_image_data", f.arv_buffer_get_image_data);
  look_up("arv_buffer_get_image_height", f.arv_buffer_get_image_height);
  look_up("arv_buffer_get_image_padding", f.arv_buffer_get_image_padding);
  look_up("arv_buffer_get_image_pixel_format", f.arv_buffer_get_image_pixel_format);
  look_up("arv_buffer_get_image_width", f.arv_buffer_get_image_width);
  look_up("arv_buffer_get_payload_type", f.arv_buffer_get_payload_type);
  look_up("arv_buffer_get_status", f.arv_buffer_get_status);
  look_up("arv_buffer_get_timestamp", f.arv_buffer_get_timestamp);
  look_up("arv_buffer_get_user_data", f.arv_buffer_get_user_data);
  look_up("arv_buffer_new_full", f.arv_buffer_new_full);
  look_up("arv_stream_get_info_uint64_by_name", f.arv_stream_get_info_uint64_by_name);
  look_up("arv_stream_get_statistics", f.arv_stream_get_statistics);
  look_up("arv_stream_push_buffer", f.arv_stream_push_buffer);
  look_up("arv_stream_try_pop_buffer", f.arv_stream_try_pop_buffer);
}

void look_up_camera_questions(Lookup& look_up, Functions& f) {
  look_up("arv_camera_dup_available_pixel_formats_as_strings",
          f.arv_camera_dup_available_pixel_formats_as_strings);
  look_up("arv_camera_get_binning", f.arv_camera_get_binning);
  look_up("arv_camera_get_device", f.arv_camera_get_device);
  look_up("arv_camera_get_device_serial_number", f.arv_camera_get_device_serial_number);
  look_up("arv_camera_get_exposure_time", f.arv_camera_get_exposure_time);
  look_up("arv_camera_get_exposure_time_bounds", f.arv_camera_get_exposure_time_bounds);
  look_up("arv_camera_get_frame_rate", f.arv_camera_get_frame_rate);
  look_up("arv_camera_get_frame_rate_bounds", f.arv_camera_get_frame_rate_bounds);
  look_up("arv_camera_get_gain", f.arv_camera_get_gain);
  look_up("arv_camera_get_gain_bounds", f.arv_camera_get_gain_bounds);
  look_up("arv_camera_get_model_name", f.arv_camera_get_model_name);
  look_up("arv_camera_get_payload", f.arv_camera_get_payload);
  look_up("arv_camera_get_pixel_format_as_string", f.arv_camera_get_pixel_format_as_string);
  look_up("arv_camera_get_region", f.arv_camera_get_region);
  look_up("arv_camera_get_sensor_size", f.arv_camera_get_sensor_size);
  look_up("arv_camera_get_vendor_name", f.arv_camera_get_vendor_name);
  look_up("arv_camera_is_binning_available", f.arv_camera_is_binning_available);
  look_up("arv_camera_is_exposure_auto_available", f.arv_camera_is_exposure_auto_available);
  look_up("arv_camera_is_exposure_time_available", f.arv_camera_is_exposure_time_available);
  look_up("arv_camera_is_frame_rate_available", f.arv_camera_is_frame_rate_available);
  look_up("arv_camera_is_gain_auto_available", f.arv_camera_is_gain_auto_available);
  look_up("arv_camera_is_gain_available", f.arv_camera_is_gain_available);
  look_up("arv_camera_is_gv_device", f.arv_camera_is_gv_device);
}

void look_up_camera_orders(Lookup& look_up, Functions& f) {
  look_up("arv_camera_clear_triggers", f.arv_camera_clear_triggers);
  look_up("arv_camera_create_stream", f.arv_camera_create_stream);
  look_up("arv_camera_gv_auto_packet_size", f.arv_camera_gv_auto_packet_size);
  look_up("arv_camera_gv_get_packet_size", f.arv_camera_gv_get_packet_size);
  look_up("arv_camera_gv_set_packet_size", f.arv_camera_gv_set_packet_size);
  look_up("arv_camera_gv_set_packet_size_adjustment", f.arv_camera_gv_set_packet_size_adjustment);
  look_up("arv_camera_new", f.arv_camera_new);
  look_up("arv_camera_new_with_device", f.arv_camera_new_with_device);
  look_up("arv_camera_set_acquisition_mode", f.arv_camera_set_acquisition_mode);
  look_up("arv_camera_set_binning", f.arv_camera_set_binning);
  look_up("arv_camera_set_exposure_time", f.arv_camera_set_exposure_time);
  look_up("arv_camera_set_exposure_time_auto", f.arv_camera_set_exposure_time_auto);
  look_up("arv_camera_set_frame_rate", f.arv_camera_set_frame_rate);
  look_up("arv_camera_set_gain", f.arv_camera_set_gain);
  look_up("arv_camera_set_gain_auto", f.arv_camera_set_gain_auto);
  look_up("arv_camera_set_pixel_format_from_string", f.arv_camera_set_pixel_format_from_string);
  look_up("arv_camera_set_region", f.arv_camera_set_region);
  look_up("arv_camera_set_trigger", f.arv_camera_set_trigger);
  look_up("arv_camera_start_acquisition", f.arv_camera_start_acquisition);
  look_up("arv_camera_stop_acquisition", f.arv_camera_stop_acquisition);
}

void look_up_devices_and_glib(Lookup& look_up, Functions& f) {
  look_up("arv_get_device_address", f.arv_get_device_address);
  look_up("arv_get_device_id", f.arv_get_device_id);
  look_up("arv_get_device_model", f.arv_get_device_model);
  look_up("arv_get_device_protocol", f.arv_get_device_protocol);
  look_up("arv_get_device_serial_nbr", f.arv_get_device_serial_nbr);
  look_up("arv_get_device_vendor", f.arv_get_device_vendor);
  look_up("arv_get_n_devices", f.arv_get_n_devices);
  look_up("arv_gv_device_is_controller", f.arv_gv_device_is_controller);
  look_up("arv_gv_device_new", f.arv_gv_device_new);
  look_up("arv_update_device_list", f.arv_update_device_list);
  look_up("g_error_free", f.g_error_free);
  look_up("g_free", f.g_free);
  look_up("g_inet_address_new_from_string", f.g_inet_address_new_from_string);
  look_up("g_object_set", f.g_object_set);
  look_up("g_object_unref", f.g_object_unref);
  look_up("g_signal_connect_data", f.g_signal_connect_data);
  look_up("g_signal_handler_disconnect", f.g_signal_handler_disconnect);
}

Functions* load(std::string& why) {
  static Functions functions;
  void* const library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    why = std::string("needs the library ") + kLibrary +
          " (Debian's package libaravis-0.8-0), which is not there: " + dlerror();
    return nullptr;
  }
  Lookup look_up(library);
  look_up_buffers_and_streams(look_up, functions);
  look_up_camera_questions(look_up, functions);
  look_up_camera_orders(look_up, functions);
  look_up_devices_and_glib(look_up, functions);
  if (!look_up.missing().empty()) {
    why = std::string("the library ") + kLibrary + " has no " + look_up.missing() +
          ", expected version 0.8.26 or later";
    return nullptr;
  }
  return &functions;
}

}  // namespace

const Functions* load_functions(std::string& why) {
  static const Functions* loaded = nullptr;  // one that is not there may be installed meanwhile
  if (loaded == nullptr) {
    loaded = load(why);
  }
  return loaded;
}

}  // namespace tubesight::drivers::aravis
