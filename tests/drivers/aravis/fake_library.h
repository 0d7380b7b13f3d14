#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "drivers/aravis/library.h"
#include "hal/clock.h"
#include "tests/drivers/aravis/fake_gige_camera.h"

namespace tubesight::tests {

/// A library with cameras of ours behind it, and the clock of the machine that it runs on: time
/// passes where somebody waits.
class FakeLibrary final : public drivers::aravis::Library, public hal::Clock {
 public:
  FakeLibrary();
  ~FakeLibrary();

  std::shared_ptr<FakeGigeCamera> plug(std::shared_ptr<FakeGigeCamera> camera) {
    cameras_.push_back(camera);
    return camera;
  }
  void advance(core::FieldTime by) { now_ += by; }
  [[nodiscard]] core::FieldTime now() const override { return now_; }

  [[nodiscard]] core::Result<drivers::aravis::Device*> open(const std::string& device,
                                                            std::string& why) override;
  void close(drivers::aravis::Device& device) override;
  [[nodiscard]] bool list(std::vector<drivers::aravis::CameraInfo>& cameras,
                          std::string& why) override;

  [[nodiscard]] int open_devices() const { return static_cast<int>(open_.size()); }

 private:
  friend class FakeDevice;
  core::FieldTime now_{std::chrono::seconds(1000)};
  std::int64_t pictures_ = 0;  ///< of all streams
  std::vector<std::shared_ptr<FakeGigeCamera>> cameras_;
  std::vector<std::unique_ptr<class FakeDevice>> open_;
};

}  // namespace tubesight::tests
