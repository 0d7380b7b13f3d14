#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/field.h"
#include "core/base/result.h"
#include "hal/clock.h"

namespace tubesight::drivers::aravis {

/// What can be set to a number.
enum class Quantity : std::uint8_t { kFrames_per_s, kExposure_us, kGain };

/// What a quantity can be.
struct Bounds {
  double least = 0.0;
  double most = 0.0;
};

/// A rectangle of the sensor, after binning.
struct Region {
  std::int32_t left_px = 0;
  std::int32_t top_px = 0;
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;

  friend constexpr bool operator==(const Region&, const Region&) = default;
};

/// A buffer that came back filled, with what the library says of it.
struct Picture {
  std::int32_t buffer = 0;         ///< index in the pool
  bool complete = false;           ///< every packet came, and it is a picture
  std::size_t bytes = 0;           ///< of the picture in the buffer
  std::uint32_t format = 0;        ///< code of the GenICam pixel format
  std::int32_t width_px = 0;       ///< as the camera says with the picture
  std::int32_t height_px = 0;      ///< as the camera says with the picture
  std::int32_t padding_bytes = 0;  ///< at the end of each line
  std::uint64_t frame_id = 0;      ///< the camera's counter
  std::uint64_t stamp_ns = 0;      ///< of the camera's clock
  core::FieldTime arrival{0};      ///< of our clock, when the last packet had come
};

/// What waiting for a picture ended with.
enum class Taken : std::uint8_t { kPicture, kNothing, kControlLost };

/// What the library has counted since begin().
struct StreamCounts {
  std::int64_t underruns = 0;        ///< pictures for which no buffer was free
  std::int64_t resent_packets = 0;   ///< that came at a second request
  std::int64_t missing_packets = 0;  ///< that never came
};

/// Where the pictures of a stream go, and how.
struct StreamPlan {
  std::span<std::byte> memory;   ///< of all buffers, one behind the other; outlives the stream
  std::size_t buffer_bytes = 0;  ///< of each
  std::int32_t buffers = 0;      ///< Device::kMostBuffers at most
  bool resend = false;
  core::FieldTime frame{0};   ///< time from one picture to the next
  std::int32_t priority = 0;  ///< of the thread that receives: SCHED_FIFO; 0: as every other
};

/// An open camera, of which we are the controller.
///
/// What may take its time stands first and belongs to one thread; take() and give_back() belong to
/// one other (or the same), between begin() and end(). Functions that can be refused say false, and
/// `why` in words.
class Device {
 public:
  static constexpr std::int32_t kMostBuffers = 32;

  [[nodiscard]] virtual std::string serial() = 0;
  [[nodiscard]] virtual std::string maker_and_model() = 0;

  [[nodiscard]] virtual std::vector<std::string> formats() = 0;
  [[nodiscard]] virtual bool set_format(const std::string& name, std::string& why) = 0;
  /// False with an empty `why`: it has none.
  [[nodiscard]] virtual bool set_binning(std::int32_t pixels, std::string& why) = 0;
  [[nodiscard]] virtual bool set_region(const Region& region, std::string& why) = 0;
  [[nodiscard]] virtual bool region(Region& region, std::string& why) = 0;
  /// The whole sensor, after binning.
  [[nodiscard]] virtual Region sensor() = 0;

  /// What makes its pictures others than those of the lens on the sensor, as its names say it:
  /// "ReverseX is on". Empty: nothing.
  [[nodiscard]] virtual std::vector<std::string> alterations() = 0;

  [[nodiscard]] virtual bool has(Quantity quantity) = 0;
  /// Switches what is automatic off where there is such a thing.
  virtual void by_hand(Quantity quantity) = 0;
  [[nodiscard]] virtual bool set(Quantity quantity, double value, std::string& why) = 0;
  [[nodiscard]] virtual bool get(Quantity quantity, double& value, std::string& why) = 0;
  /// False: it does not say them.
  [[nodiscard]] virtual bool bounds(Quantity quantity, Bounds& bounds) = 0;

  /// Empty: the camera goes at its own rate.
  [[nodiscard]] virtual bool set_trigger(const std::string& line, std::string& why) = 0;

  /// Whether pictures come in packets of a network.
  [[nodiscard]] virtual bool has_packets() = 0;
  [[nodiscard]] virtual bool set_packet_size(std::int32_t bytes, std::string& why) = 0;
  /// Finds the largest that comes through, by packets made for it.
  [[nodiscard]] virtual bool negotiate_packet_size(std::string& why) = 0;
  /// 0: it does not say it.
  [[nodiscard]] virtual std::int32_t packet_size() = 0;

  /// Bytes of one picture, with all that the camera sends beside it; 0: it does not say it.
  [[nodiscard]] virtual std::size_t payload() = 0;

  /// Stops what a camera may still be sending.
  virtual void quieten() = 0;
  /// Starts the stream. `clock` is the system's monotonic one and outlives it.
  [[nodiscard]] virtual bool begin(const StreamPlan& plan, const hal::Clock& clock,
                                   std::string& why) = 0;
  /// Ends it; all buffers are ours again. `gone`: the camera does not answer, and is not asked to
  /// stop: each question to it takes seconds.
  virtual void end(bool gone) = 0;
  /// Gives buffers back to the library that it was too quiet to take itself; between begin() and
  /// end(), of any thread but that which takes.
  virtual void look_after() = 0;
  [[nodiscard]] virtual StreamCounts counts() = 0;

  /// Waits for a picture. Allocates nothing.
  [[nodiscard]] virtual Taken take(std::chrono::milliseconds timeout, Picture& picture) = 0;
  /// Never waits. Allocates nothing.
  virtual void give_back(std::int32_t buffer) = 0;

 protected:
  ~Device() = default;
};

/// A camera that answered a broadcast.
struct CameraInfo {
  std::string serial;
  std::string address;
  std::string maker_and_model;
  std::string protocol;
};

/// What the driver takes of the library Aravis, and nothing else of it: where a test puts cameras
/// of its own.
class Library {
 public:
  /// Opens a camera by "address:..." or "serial:..." and takes its control; may take seconds. It
  /// lives until close(). Errors: kDisconnected it is not there, kIo it cannot be had; `why` says
  /// it.
  [[nodiscard]] virtual core::Result<Device*> open(const std::string& device, std::string& why) = 0;
  virtual void close(Device& device) = 0;

  /// Asks all networks, by broadcast, which cameras there are. False, with `why`: it could not.
  [[nodiscard]] virtual bool list(std::vector<CameraInfo>& cameras, std::string& why) = 0;

 protected:
  ~Library() = default;
};

/// Aravis, loaded when it is first needed.
[[nodiscard]] Library& system_library();

}  // namespace tubesight::drivers::aravis
