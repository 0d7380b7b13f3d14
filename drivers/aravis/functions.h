#pragma once

#include <string>

#include <arv.h>

namespace tubesight::drivers::aravis {

/// The functions of Aravis, and of GLib below it, that the driver calls, by their own names.
///
/// They are looked up when a camera is first opened, so that a program without one neither needs
/// the library nor carries it: with what it stands on it is 50 MB, which a box that locks its
/// memory would hold for nothing.
struct Functions {
  decltype(&::arv_buffer_get_frame_id) arv_buffer_get_frame_id = nullptr;
  decltype(&::arv_buffer_get_image_data) arv_buffer_get_image_data = nullptr;
  decltype(&::arv_buffer_get_image_height) arv_buffer_get_image_height = nullptr;
  decltype(&::arv_buffer_get_image_padding) arv_buffer_get_image_padding = nullptr;
  decltype(&::arv_buffer_get_image_pixel_format) arv_buffer_get_image_pixel_format = nullptr;
  decltype(&::arv_buffer_get_image_width) arv_buffer_get_image_width = nullptr;
  decltype(&::arv_buffer_get_payload_type) arv_buffer_get_payload_type = nullptr;
  decltype(&::arv_buffer_get_status) arv_buffer_get_status = nullptr;
  decltype(&::arv_buffer_get_timestamp) arv_buffer_get_timestamp = nullptr;
  decltype(&::arv_buffer_get_user_data) arv_buffer_get_user_data = nullptr;
  decltype(&::arv_buffer_new_full) arv_buffer_new_full = nullptr;
  decltype(&::arv_camera_clear_triggers) arv_camera_clear_triggers = nullptr;
  decltype(&::arv_camera_create_stream) arv_camera_create_stream = nullptr;
  decltype(&::arv_camera_dup_available_pixel_formats_as_strings)
      arv_camera_dup_available_pixel_formats_as_strings = nullptr;
  decltype(&::arv_camera_get_binning) arv_camera_get_binning = nullptr;
  decltype(&::arv_camera_get_device) arv_camera_get_device = nullptr;
  decltype(&::arv_camera_get_device_serial_number) arv_camera_get_device_serial_number = nullptr;
  decltype(&::arv_camera_get_exposure_time) arv_camera_get_exposure_time = nullptr;
  decltype(&::arv_camera_get_exposure_time_bounds) arv_camera_get_exposure_time_bounds = nullptr;
  decltype(&::arv_camera_get_frame_rate) arv_camera_get_frame_rate = nullptr;
  decltype(&::arv_camera_get_frame_rate_bounds) arv_camera_get_frame_rate_bounds = nullptr;
  decltype(&::arv_camera_get_gain) arv_camera_get_gain = nullptr;
  decltype(&::arv_camera_get_gain_bounds) arv_camera_get_gain_bounds = nullptr;
  decltype(&::arv_camera_get_model_name) arv_camera_get_model_name = nullptr;
  decltype(&::arv_camera_get_payload) arv_camera_get_payload = nullptr;
  decltype(&::arv_camera_get_pixel_format_as_string) arv_camera_get_pixel_format_as_string =
      nullptr;
  decltype(&::arv_camera_get_region) arv_camera_get_region = nullptr;
  decltype(&::arv_camera_get_sensor_size) arv_camera_get_sensor_size = nullptr;
  decltype(&::arv_camera_get_vendor_name) arv_camera_get_vendor_name = nullptr;
  decltype(&::arv_camera_gv_auto_packet_size) arv_camera_gv_auto_packet_size = nullptr;
  decltype(&::arv_camera_gv_get_packet_size) arv_camera_gv_get_packet_size = nullptr;
  decltype(&::arv_camera_gv_set_packet_size) arv_camera_gv_set_packet_size = nullptr;
  decltype(&::arv_camera_gv_set_packet_size_adjustment) arv_camera_gv_set_packet_size_adjustment =
      nullptr;
  decltype(&::arv_camera_is_binning_available) arv_camera_is_binning_available = nullptr;
  decltype(&::arv_camera_is_exposure_auto_available) arv_camera_is_exposure_auto_available =
      nullptr;
  decltype(&::arv_camera_is_exposure_time_available) arv_camera_is_exposure_time_available =
      nullptr;
  decltype(&::arv_camera_is_frame_rate_available) arv_camera_is_frame_rate_available = nullptr;
  decltype(&::arv_camera_is_gain_auto_available) arv_camera_is_gain_auto_available = nullptr;
  decltype(&::arv_camera_is_gain_available) arv_camera_is_gain_available = nullptr;
  decltype(&::arv_camera_is_gv_device) arv_camera_is_gv_device = nullptr;
  decltype(&::arv_camera_new) arv_camera_new = nullptr;
  decltype(&::arv_camera_new_with_device) arv_camera_new_with_device = nullptr;
  decltype(&::arv_camera_set_acquisition_mode) arv_camera_set_acquisition_mode = nullptr;
  decltype(&::arv_camera_set_binning) arv_camera_set_binning = nullptr;
  decltype(&::arv_camera_set_exposure_time) arv_camera_set_exposure_time = nullptr;
  decltype(&::arv_camera_set_exposure_time_auto) arv_camera_set_exposure_time_auto = nullptr;
  decltype(&::arv_camera_set_frame_rate) arv_camera_set_frame_rate = nullptr;
  decltype(&::arv_camera_set_gain) arv_camera_set_gain = nullptr;
  decltype(&::arv_camera_set_gain_auto) arv_camera_set_gain_auto = nullptr;
  decltype(&::arv_camera_set_pixel_format_from_string) arv_camera_set_pixel_format_from_string =
      nullptr;
  decltype(&::arv_camera_set_region) arv_camera_set_region = nullptr;
  decltype(&::arv_camera_set_trigger) arv_camera_set_trigger = nullptr;
  decltype(&::arv_camera_start_acquisition) arv_camera_start_acquisition = nullptr;
  decltype(&::arv_camera_stop_acquisition) arv_camera_stop_acquisition = nullptr;
  decltype(&::arv_get_device_address) arv_get_device_address = nullptr;
  decltype(&::arv_get_device_id) arv_get_device_id = nullptr;
  decltype(&::arv_get_device_model) arv_get_device_model = nullptr;
  decltype(&::arv_get_device_protocol) arv_get_device_protocol = nullptr;
  decltype(&::arv_get_device_serial_nbr) arv_get_device_serial_nbr = nullptr;
  decltype(&::arv_get_device_vendor) arv_get_device_vendor = nullptr;
  decltype(&::arv_get_n_devices) arv_get_n_devices = nullptr;
  decltype(&::arv_gv_device_is_controller) arv_gv_device_is_controller = nullptr;
  decltype(&::arv_gv_device_new) arv_gv_device_new = nullptr;
  decltype(&::arv_stream_get_info_uint64_by_name) arv_stream_get_info_uint64_by_name = nullptr;
  decltype(&::arv_stream_get_statistics) arv_stream_get_statistics = nullptr;
  decltype(&::arv_stream_push_buffer) arv_stream_push_buffer = nullptr;
  decltype(&::arv_stream_try_pop_buffer) arv_stream_try_pop_buffer = nullptr;
  decltype(&::arv_update_device_list) arv_update_device_list = nullptr;
  decltype(&::g_error_free) g_error_free = nullptr;
  decltype(&::g_free) g_free = nullptr;
  decltype(&::g_inet_address_new_from_string) g_inet_address_new_from_string = nullptr;
  decltype(&::g_object_set) g_object_set = nullptr;
  decltype(&::g_object_unref) g_object_unref = nullptr;
  decltype(&::g_signal_connect_data) g_signal_connect_data = nullptr;
  decltype(&::g_signal_handler_disconnect) g_signal_handler_disconnect = nullptr;
};

/// Those of the library on this machine; null with `why` where there is none. Loaded once.
[[nodiscard]] const Functions* load_functions(std::string& why);

}  // namespace tubesight::drivers::aravis
