#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/base/field.h"
#include "drivers/aravis/library.h"

namespace tubesight::tests {

/// A camera of the fake library: what it has, and what it does wrong. All may be changed at any
/// time.
struct FakeGigeCamera {
  struct Number {
    double value = 0.0;
    drivers::aravis::Bounds bounds;
    double step = 0.0;    ///< values are rounded to multiples of it; 0: kept as they are
    bool by_hand = true;  ///< nothing automatic sets it
  };

  // What it is.
  std::string device = "address:10.0.0.2";
  std::string serial = "4711";
  std::vector<std::string> formats{"Mono8"};
  bool binning = true;
  drivers::aravis::Region sensor{0, 0, 1024, 768};
  std::int32_t widths_of = 1;  ///< a width is rounded down to a multiple of it
  std::map<drivers::aravis::Quantity, Number> numbers{
      {drivers::aravis::Quantity::kFrames_per_s, {30.0, {1.0, 100.0}}},
      {drivers::aravis::Quantity::kExposure_us, {2000.0, {10.0, 30'000.0}, 0.0, false}},
      {drivers::aravis::Quantity::kGain, {0.0, {0.0, 12.0}, 0.0, false}}};
  std::vector<std::string> alterations;  ///< "ReverseX is on"
  std::vector<std::string> triggers{"Line1"};
  bool packets = true;
  std::int32_t negotiated_packet = 8000;
  std::int32_t path = 9000;  ///< packets beyond it get lost
  std::int32_t least_packet = 200;
  std::size_t bytes_beside = 0;  ///< of a picture's payload

  // What it does.
  core::FieldTime every{33'333'333};  ///< time from one picture to the next; 0: none comes
  core::FieldTime delay{15'000'000};  ///< of a picture's arrival behind its stamp
  std::int64_t clock_ahead_ns = 77'000'000'000;
  std::int64_t clock_fast_ppb = 0;
  std::uint64_t first_id = 1;
  std::uint64_t last_id = 65'535;  ///< then comes 1
  /// What the camera says and a picture shows may be changed here before it arrives; `number`
  /// counts the pictures of all streams from 0.
  std::function<void(std::int64_t number, drivers::aravis::Picture& picture,
                     std::span<std::byte> memory)>
      tamper;
  bool busy = false;          ///< another program has its control
  bool absent = false;        ///< it does not answer
  bool taken = false;         ///< control is lost
  bool starts = true;         ///< or refuses to
  bool refuses_size = false;  ///< of packets
  std::string kept_format;    ///< not empty: it keeps this one
  drivers::aravis::StreamCounts counts;

  // What was set.
  std::string format;
  drivers::aravis::Region region;
  std::int32_t binned = 1;
  std::string trigger;
  std::int32_t packet = 1500;
  drivers::aravis::StreamPlan plan;
  bool stopped = false;  ///< at the end of its last stream
};

/// Lays a line of grey bytes into memory as a format wants it, with noise in the bits that 8 do not
/// hold. Written anew, from the figures of the GigE Vision and the GenICam standards.
void lay_line(const std::string& format, std::span<const std::uint8_t> greys, std::byte* to);

/// Bytes of a line in a format.
[[nodiscard]] std::size_t line_bytes(const std::string& format, std::int32_t width_px);

/// The code of a format.
[[nodiscard]] std::uint32_t code_of(const std::string& format);

}  // namespace tubesight::tests
