#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include <semaphore.h>

#include "core/base/spsc_queue.h"
#include "drivers/aravis/functions.h"
#include "drivers/aravis/library.h"

namespace tubesight::drivers::aravis {

/// A camera that Aravis has opened.
///
/// Buffers pass to and fro by two rings, so that the thread which takes pictures calls nothing of
/// the library, whose queues allocate: the library's thread takes a filled buffer out of its queue
/// itself and puts those that came back into the other.
class SystemDevice final : public Device {
 public:
  /// `camera` is ours from now on.
  SystemDevice(const Functions& functions, ArvCamera* camera);
  SystemDevice(const SystemDevice&) = delete;
  SystemDevice& operator=(const SystemDevice&) = delete;
  ~SystemDevice();

  [[nodiscard]] std::string serial() override;
  [[nodiscard]] std::string maker_and_model() override;
  [[nodiscard]] std::vector<std::string> formats() override;
  [[nodiscard]] bool set_format(const std::string& name, std::string& why) override;
  [[nodiscard]] bool set_binning(std::int32_t pixels, std::string& why) override;
  [[nodiscard]] bool set_region(const Region& region, std::string& why) override;
  [[nodiscard]] bool region(Region& region, std::string& why) override;
  [[nodiscard]] Region sensor() override;
  [[nodiscard]] std::vector<std::string> alterations() override;
  [[nodiscard]] bool has(Quantity quantity) override;
  void by_hand(Quantity quantity) override;
  [[nodiscard]] bool set(Quantity quantity, double value, std::string& why) override;
  [[nodiscard]] bool get(Quantity quantity, double& value, std::string& why) override;
  [[nodiscard]] bool bounds(Quantity quantity, Bounds& bounds) override;
  [[nodiscard]] bool set_trigger(const std::string& line, std::string& why) override;
  [[nodiscard]] bool has_packets() override;
  [[nodiscard]] bool set_packet_size(std::int32_t bytes, std::string& why) override;
  [[nodiscard]] bool negotiate_packet_size(std::string& why) override;
  [[nodiscard]] std::int32_t packet_size() override;
  [[nodiscard]] std::size_t payload() override;
  void quieten() override;

  [[nodiscard]] bool begin(const StreamPlan& plan, const hal::Clock& clock,
                           std::string& why) override;
  void end(bool gone) override;
  void look_after() override;
  [[nodiscard]] StreamCounts counts() override;
  [[nodiscard]] Taken take(std::chrono::milliseconds timeout, Picture& picture) override;
  void give_back(std::int32_t buffer) override;

 private:
  static void on_stream(void* self, ArvStreamCallbackType what, ArvBuffer* buffer);
  static void on_control_lost(ArvDevice* device, void* self);

  [[nodiscard]] ArvStream* create_stream(const StreamPlan& plan, std::string& why);
  void pass_on(ArvBuffer* buffer);
  void push(std::int32_t buffer);

  static constexpr std::uint32_t kMostBuffers = Device::kMostBuffers;

  const Functions* arv_;
  ArvCamera* camera_;
  unsigned long control_lost_handler_ = 0;

  // Of one stream.
  ArvStream* stream_ = nullptr;
  const hal::Clock* clock_ = nullptr;
  std::int32_t buffers_ = 0;
  std::int32_t priority_ = 0;  ///< of the library's thread
  std::atomic<bool> running_{false};
  std::mutex queues_;  ///< the library's; never of the thread that takes
  std::array<ArvBuffer*, kMostBuffers> buffer_{};
  std::array<bool, kMostBuffers> ours_{};  ///< it is not in the library's queues

  core::SpscQueue<Picture, kMostBuffers> arrived_;
  core::SpscQueue<std::int32_t, kMostBuffers> returned_;
  std::atomic<bool> control_lost_{false};
  sem_t news_{};
};

}  // namespace tubesight::drivers::aravis
