#include "tests/system/gige_camera.h"

#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tubesight::tests {

std::vector<std::string> frames_of(const std::vector<core::Field>& fields,
                                   const core::CameraSettings& camera) {
  const auto width = static_cast<std::size_t>(camera.width_px);
  const std::size_t bytes = width * static_cast<std::size_t>(camera.height_px);
  std::vector<std::string> frames;
  for (const core::Field& field : fields) {
    const auto frame = static_cast<std::size_t>(field.number / 2);
    if (frames.size() <= frame) {
      frames.emplace_back(bytes, '\0');
    }
    for (std::int32_t line = 0; line < field.pixels.lines; ++line) {
      const auto to =
          static_cast<std::size_t>(field.pixels.first_line + line * field.pixels.line_step);
      std::memcpy(frames[frame].data() + to * width,
                  field.pixels.pixels + static_cast<std::ptrdiff_t>(line) * field.pixels.stride_px,
                  width);
    }
  }
  return frames;
}

void GigeCamera::show(const std::vector<std::string>& frames, const core::CameraSettings& camera,
                      int lead) {
  std::string all;
  for (const std::string& frame : frames) {
    all += frame;
  }
  folder_.write("pictures", all);
  width_px_ = camera.width_px;
  height_px_ = camera.height_px;
  lead_ = lead;
}

bool GigeCamera::start(const std::string& serial, double lost_packets) {
  kill_it();
  folder_.write("said", "");
  folder_.write("error", "");
  std::vector<std::string> words{TUBESIGHT_GIGE_CAMERA,
                                 "127.0.0.1",
                                 serial,
                                 folder_.path("pictures"),
                                 std::to_string(width_px_),
                                 std::to_string(height_px_),
                                 std::to_string(lead_),
                                 std::to_string(lost_packets)};
  std::vector<char*> arguments;
  for (std::string& word : words) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  const std::string said = folder_.path("said");
  const std::string error = folder_.path("error");
  process_ = fork();
  if (process_ == 0) {
    dup2(open(said.c_str(), O_WRONLY | O_APPEND), STDOUT_FILENO);
    dup2(open(error.c_str(), O_WRONLY | O_APPEND), STDERR_FILENO);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  for (int i = 0; i < 1000 && folder_.read("said").empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return folder_.read("said") == "ready\n";
}

void GigeCamera::kill_it() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  process_ = 0;
}

}  // namespace tubesight::tests
