#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include <arv.h>

namespace tubesight::drivers::aravis {

/// A name of a library and where it was found.
struct Place {
  const char* name = nullptr;
  void* at = nullptr;
};

/// All names of one list, in its order.
class Places {
 public:
  /// More than a list has.
  static constexpr std::size_t kMost = 96;

  std::size_t add(const char* name) {
    places_.at(count_) = {name, nullptr};
    return count_++;
  }
  [[nodiscard]] std::span<Place> all() { return std::span(places_).first(count_); }
  [[nodiscard]] void* at(std::size_t index) const { return places_[index].at; }

 private:
  std::array<Place, kMost> places_{};
  std::size_t count_ = 0;
};

/// A function of a library, to be called by its own name once all have been looked up.
template <typename Pointer>
class Symbol {
 public:
  Symbol(Places& places, const char* name) : places_(&places), index_(places.add(name)) {}

  // As a call needs it, of functions with any number of arguments too.
  operator Pointer() const { return reinterpret_cast<Pointer>(places_->at(index_)); }

 private:
  const Places* places_;
  std::size_t index_;
};

/// The functions of Aravis, and of GLib below it, that the driver calls, by their own names.
///
/// They are looked up when a camera is first opened, so that a program without one neither needs
/// the library nor carries it: with what it stands on it is 50 MB, which a box that locks its
/// memory would hold for nothing.
struct Functions {
  Functions() = default;
  Functions(const Functions&) = delete;
  Functions& operator=(const Functions&) = delete;

  Places all;
  Symbol<decltype(&::arv_buffer_get_frame_id)> arv_buffer_get_frame_id{all,
                                                                       "arv_buffer_get_frame_id"};
  Symbol<decltype(&::arv_buffer_get_image_data)> arv_buffer_get_image_data{
      all, "arv_buffer_get_image_data"};
  Symbol<decltype(&::arv_buffer_get_image_height)> arv_buffer_get_image_height{
      all, "arv_buffer_get_image_height"};
  Symbol<decltype(&::arv_buffer_get_image_padding)> arv_buffer_get_image_padding{
      all, "arv_buffer_get_image_padding"};
  Symbol<decltype(&::arv_buffer_get_image_pixel_format)> arv_buffer_get_image_pixel_format{
      all, "arv_buffer_get_image_pixel_format"};
  Symbol<decltype(&::arv_buffer_get_image_width)> arv_buffer_get_image_width{
      all, "arv_buffer_get_image_width"};
  Symbol<decltype(&::arv_buffer_get_payload_type)> arv_buffer_get_payload_type{
      all, "arv_buffer_get_payload_type"};
  Symbol<decltype(&::arv_buffer_get_status)> arv_buffer_get_status{all, "arv_buffer_get_status"};
  Symbol<decltype(&::arv_buffer_get_timestamp)> arv_buffer_get_timestamp{
      all, "arv_buffer_get_timestamp"};
  Symbol<decltype(&::arv_buffer_get_user_data)> arv_buffer_get_user_data{
      all, "arv_buffer_get_user_data"};
  Symbol<decltype(&::arv_buffer_new_full)> arv_buffer_new_full{all, "arv_buffer_new_full"};
  Symbol<decltype(&::arv_camera_clear_triggers)> arv_camera_clear_triggers{
      all, "arv_camera_clear_triggers"};
  Symbol<decltype(&::arv_camera_create_stream)> arv_camera_create_stream{
      all, "arv_camera_create_stream"};
  Symbol<decltype(&::arv_camera_dup_available_pixel_formats_as_strings)>
      arv_camera_dup_available_pixel_formats_as_strings{
          all, "arv_camera_dup_available_pixel_formats_as_strings"};
  Symbol<decltype(&::arv_camera_get_binning)> arv_camera_get_binning{all, "arv_camera_get_binning"};
  Symbol<decltype(&::arv_camera_get_boolean)> arv_camera_get_boolean{all, "arv_camera_get_boolean"};
  Symbol<decltype(&::arv_camera_get_device)> arv_camera_get_device{all, "arv_camera_get_device"};
  Symbol<decltype(&::arv_camera_get_device_serial_number)> arv_camera_get_device_serial_number{
      all, "arv_camera_get_device_serial_number"};
  Symbol<decltype(&::arv_camera_get_exposure_time)> arv_camera_get_exposure_time{
      all, "arv_camera_get_exposure_time"};
  Symbol<decltype(&::arv_camera_get_exposure_time_bounds)> arv_camera_get_exposure_time_bounds{
      all, "arv_camera_get_exposure_time_bounds"};
  Symbol<decltype(&::arv_camera_get_frame_rate)> arv_camera_get_frame_rate{
      all, "arv_camera_get_frame_rate"};
  Symbol<decltype(&::arv_camera_get_frame_rate_bounds)> arv_camera_get_frame_rate_bounds{
      all, "arv_camera_get_frame_rate_bounds"};
  Symbol<decltype(&::arv_camera_get_gain)> arv_camera_get_gain{all, "arv_camera_get_gain"};
  Symbol<decltype(&::arv_camera_get_gain_bounds)> arv_camera_get_gain_bounds{
      all, "arv_camera_get_gain_bounds"};
  Symbol<decltype(&::arv_camera_get_integer)> arv_camera_get_integer{all, "arv_camera_get_integer"};
  Symbol<decltype(&::arv_camera_get_model_name)> arv_camera_get_model_name{
      all, "arv_camera_get_model_name"};
  Symbol<decltype(&::arv_camera_get_payload)> arv_camera_get_payload{all, "arv_camera_get_payload"};
  Symbol<decltype(&::arv_camera_get_pixel_format_as_string)> arv_camera_get_pixel_format_as_string{
      all, "arv_camera_get_pixel_format_as_string"};
  Symbol<decltype(&::arv_camera_get_region)> arv_camera_get_region{all, "arv_camera_get_region"};
  Symbol<decltype(&::arv_camera_get_sensor_size)> arv_camera_get_sensor_size{
      all, "arv_camera_get_sensor_size"};
  Symbol<decltype(&::arv_camera_get_string)> arv_camera_get_string{all, "arv_camera_get_string"};
  Symbol<decltype(&::arv_camera_get_vendor_name)> arv_camera_get_vendor_name{
      all, "arv_camera_get_vendor_name"};
  Symbol<decltype(&::arv_camera_gv_auto_packet_size)> arv_camera_gv_auto_packet_size{
      all, "arv_camera_gv_auto_packet_size"};
  Symbol<decltype(&::arv_camera_gv_get_packet_size)> arv_camera_gv_get_packet_size{
      all, "arv_camera_gv_get_packet_size"};
  Symbol<decltype(&::arv_camera_gv_set_packet_size)> arv_camera_gv_set_packet_size{
      all, "arv_camera_gv_set_packet_size"};
  Symbol<decltype(&::arv_camera_gv_set_packet_size_adjustment)>
      arv_camera_gv_set_packet_size_adjustment{all, "arv_camera_gv_set_packet_size_adjustment"};
  Symbol<decltype(&::arv_camera_is_binning_available)> arv_camera_is_binning_available{
      all, "arv_camera_is_binning_available"};
  Symbol<decltype(&::arv_camera_is_exposure_auto_available)> arv_camera_is_exposure_auto_available{
      all, "arv_camera_is_exposure_auto_available"};
  Symbol<decltype(&::arv_camera_is_exposure_time_available)> arv_camera_is_exposure_time_available{
      all, "arv_camera_is_exposure_time_available"};
  Symbol<decltype(&::arv_camera_is_feature_available)> arv_camera_is_feature_available{
      all, "arv_camera_is_feature_available"};
  Symbol<decltype(&::arv_camera_is_frame_rate_available)> arv_camera_is_frame_rate_available{
      all, "arv_camera_is_frame_rate_available"};
  Symbol<decltype(&::arv_camera_is_gain_auto_available)> arv_camera_is_gain_auto_available{
      all, "arv_camera_is_gain_auto_available"};
  Symbol<decltype(&::arv_camera_is_gain_available)> arv_camera_is_gain_available{
      all, "arv_camera_is_gain_available"};
  Symbol<decltype(&::arv_camera_is_gv_device)> arv_camera_is_gv_device{all,
                                                                       "arv_camera_is_gv_device"};
  Symbol<decltype(&::arv_camera_new)> arv_camera_new{all, "arv_camera_new"};
  Symbol<decltype(&::arv_camera_new_with_device)> arv_camera_new_with_device{
      all, "arv_camera_new_with_device"};
  Symbol<decltype(&::arv_camera_set_acquisition_mode)> arv_camera_set_acquisition_mode{
      all, "arv_camera_set_acquisition_mode"};
  Symbol<decltype(&::arv_camera_set_binning)> arv_camera_set_binning{all, "arv_camera_set_binning"};
  Symbol<decltype(&::arv_camera_set_exposure_time)> arv_camera_set_exposure_time{
      all, "arv_camera_set_exposure_time"};
  Symbol<decltype(&::arv_camera_set_exposure_time_auto)> arv_camera_set_exposure_time_auto{
      all, "arv_camera_set_exposure_time_auto"};
  Symbol<decltype(&::arv_camera_set_frame_rate)> arv_camera_set_frame_rate{
      all, "arv_camera_set_frame_rate"};
  Symbol<decltype(&::arv_camera_set_gain)> arv_camera_set_gain{all, "arv_camera_set_gain"};
  Symbol<decltype(&::arv_camera_set_gain_auto)> arv_camera_set_gain_auto{
      all, "arv_camera_set_gain_auto"};
  Symbol<decltype(&::arv_camera_set_pixel_format_from_string)>
      arv_camera_set_pixel_format_from_string{all, "arv_camera_set_pixel_format_from_string"};
  Symbol<decltype(&::arv_camera_set_region)> arv_camera_set_region{all, "arv_camera_set_region"};
  Symbol<decltype(&::arv_camera_set_trigger)> arv_camera_set_trigger{all, "arv_camera_set_trigger"};
  Symbol<decltype(&::arv_camera_start_acquisition)> arv_camera_start_acquisition{
      all, "arv_camera_start_acquisition"};
  Symbol<decltype(&::arv_camera_stop_acquisition)> arv_camera_stop_acquisition{
      all, "arv_camera_stop_acquisition"};
  Symbol<decltype(&::arv_get_device_address)> arv_get_device_address{all, "arv_get_device_address"};
  Symbol<decltype(&::arv_get_device_id)> arv_get_device_id{all, "arv_get_device_id"};
  Symbol<decltype(&::arv_get_device_model)> arv_get_device_model{all, "arv_get_device_model"};
  Symbol<decltype(&::arv_get_device_protocol)> arv_get_device_protocol{all,
                                                                       "arv_get_device_protocol"};
  Symbol<decltype(&::arv_get_device_serial_nbr)> arv_get_device_serial_nbr{
      all, "arv_get_device_serial_nbr"};
  Symbol<decltype(&::arv_get_device_vendor)> arv_get_device_vendor{all, "arv_get_device_vendor"};
  Symbol<decltype(&::arv_get_n_devices)> arv_get_n_devices{all, "arv_get_n_devices"};
  Symbol<decltype(&::arv_gv_device_is_controller)> arv_gv_device_is_controller{
      all, "arv_gv_device_is_controller"};
  Symbol<decltype(&::arv_gv_device_new)> arv_gv_device_new{all, "arv_gv_device_new"};
  Symbol<decltype(&::arv_stream_get_info_uint64_by_name)> arv_stream_get_info_uint64_by_name{
      all, "arv_stream_get_info_uint64_by_name"};
  Symbol<decltype(&::arv_stream_get_statistics)> arv_stream_get_statistics{
      all, "arv_stream_get_statistics"};
  Symbol<decltype(&::arv_stream_push_buffer)> arv_stream_push_buffer{all, "arv_stream_push_buffer"};
  Symbol<decltype(&::arv_stream_try_pop_buffer)> arv_stream_try_pop_buffer{
      all, "arv_stream_try_pop_buffer"};
  Symbol<decltype(&::arv_update_device_list)> arv_update_device_list{all, "arv_update_device_list"};
  Symbol<decltype(&::g_error_free)> g_error_free{all, "g_error_free"};
  Symbol<decltype(&::g_free)> g_free{all, "g_free"};
  Symbol<decltype(&::g_inet_address_new_from_string)> g_inet_address_new_from_string{
      all, "g_inet_address_new_from_string"};
  // Its own type has an attribute that a template does not take.
  Symbol<void (*)(gpointer, const gchar*, ...)> g_object_set{all, "g_object_set"};
  Symbol<decltype(&::g_object_unref)> g_object_unref{all, "g_object_unref"};
  Symbol<decltype(&::g_signal_connect_data)> g_signal_connect_data{all, "g_signal_connect_data"};
  Symbol<decltype(&::g_signal_handler_disconnect)> g_signal_handler_disconnect{
      all, "g_signal_handler_disconnect"};
};

/// Those of the library on this machine; null with `why` where there is none. Loaded once.
[[nodiscard]] const Functions* load_functions(std::string& why);

}  // namespace tubesight::drivers::aravis
