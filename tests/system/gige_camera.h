#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <sys/types.h>

#include "core/base/field.h"
#include "core/base/settings.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::tests {

/// Whole frames of a recording's fields, each as bytes line by line.
[[nodiscard]] std::vector<std::string> frames_of(const std::vector<core::Field>& fields,
                                                 const core::CameraSettings& camera);

/// A camera of GigE Vision in a process of its own, at 127.0.0.1.
class GigeCamera {
 public:
  GigeCamera() = default;
  GigeCamera(const GigeCamera&) = delete;
  GigeCamera& operator=(const GigeCamera&) = delete;
  ~GigeCamera() { kill_it(); }

  /// What it shows: the first picture `lead` times more, the last for ever.
  void show(const std::vector<std::string>& frames, const core::CameraSettings& camera, int lead);
  /// Starts it and waits until it listens; false: it does not, and error() says why.
  [[nodiscard]] bool start(const std::string& serial = "4711", double lost_packets = 0.0);
  /// As when its cable is pulled: nothing is said, nothing more comes.
  void kill_it();
  [[nodiscard]] std::string error() const { return folder_.read("error"); }

 private:
  support::TemporaryFolder folder_;
  std::int32_t width_px_ = 0;
  std::int32_t height_px_ = 0;
  int lead_ = 0;
  pid_t process_ = 0;
};

}  // namespace tubesight::tests
