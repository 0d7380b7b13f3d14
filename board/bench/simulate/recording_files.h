#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "drivers/files/atomic_file.h"
#include "drivers/files/y4m_writer.h"
#include "drivers/scenario/tubes_in_view.h"
#include "drivers/simulated/simulated_world.h"

namespace tubesight::board {

/// What stands behind NAME in the names of a simulation's files.
inline constexpr std::array<const char*, 6> kRecordingSuffixes = {
    ".y4m", ".meta.csv", ".events.csv", ".truth.csv", ".centers.csv", ".session.toml"};

/// The files of a simulated recording. They appear under their names when commit() succeeds, and
/// not before. Errors are kIo, and message() tells in one line.
///
/// A frame of which one field was lost has its place all the same: the lost field is marked as
/// damaged and shows the lines that stood there before. A frame whose fields are all lost is left
/// out.
class RecordingFiles {
 public:
  /// Begins the files of `name` (a path without suffix); `heading` are the first lines of the
  /// session file: comments.
  [[nodiscard]] core::Result<void> open(const std::string& name, const drivers::Scenario& scenario,
                                        const std::string& heading);

  /// Appends the next slot of the world, delivered or lost, in order.
  [[nodiscard]] core::Result<void> add(const drivers::SimulatedWorld& world,
                                       const drivers::SimulatedField& field);

  /// Puts the files in their places.
  [[nodiscard]] core::Result<void> commit();

  [[nodiscard]] const std::string& message() const { return message_; }
  [[nodiscard]] std::int64_t frames() const { return frames_; }

 private:
  [[nodiscard]] core::Result<void> write_frame(const drivers::SimulatedWorld& world);
  void add_rows(const drivers::SimulatedWorld& world, const drivers::SimulatedField& field,
                std::int32_t index, bool centers);
  [[nodiscard]] core::Result<void> checked(core::Result<void> result, const std::string& why);

  const drivers::Scenario* scenario_ = nullptr;
  drivers::Y4mWriter video_;
  std::array<drivers::AtomicFile, 5> texts_;    ///< in the order of kRecordingSuffixes
  std::array<std::string, 5> rows_;             ///< of the frame at hand
  std::vector<drivers::SimulatedField> slots_;  ///< of the frame at hand
  std::vector<drivers::TubeInView> in_view_;
  std::optional<std::int64_t> last_slot_;  ///< that is delivered; found with the first slot
  std::int64_t frames_ = 0;
  bool start_passed_ = false;  ///< the start event of the settings, which the session file has
  std::string message_;
};

}  // namespace tubesight::board
