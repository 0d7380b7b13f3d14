#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/field.h"
#include "drivers/files/atomic_file.h"
#include "drivers/files/y4m_writer.h"
#include "drivers/recording/recording_folder.h"
#include "hal/recording_store.h"

namespace tubesight::drivers {

/// Keeps recordings as files in a folder: pictures, meta, events, state and the session's settings,
/// as docs/file-formats.md describes them, for `tubesight replay`.
///
/// A recording's files appear under their names when all of it is written, the picture last. The
/// oldest recordings go first when they become too many; other files of the folder are left alone.
/// What failed is told by message(). It allocates: never on the tracking thread.
class FileRecordingStore final : public hal::RecordingStore {
 public:
  /// Seconds since 1970, UTC, for names: of the board's clock, as nothing below it asks one.
  using WallClock = std::function<std::int64_t()>;

  /// `most_mb`: of 2^20 bytes, of all recordings in the folder together. `session`: the text of the
  /// session's settings file, which each recording gets a copy of.
  FileRecordingStore(std::string folder, std::int64_t most_mb, std::string session,
                     WallClock wall_clock);

  /// Claims the folder for this store alone, and removes what a box that was stopped left
  /// unfinished. Call before the first recording, again where it failed. Errors: kNotReady another
  /// box records there; kIo the folder is not there or cannot be read.
  [[nodiscard]] core::Result<void> open();

  [[nodiscard]] core::Result<void> begin(const hal::RecordingHead& head) override;
  [[nodiscard]] core::Result<void> add(const core::Field& field,
                                       std::span<const core::Event> events) override;
  [[nodiscard]] core::Result<void> finish() override;

  /// Room for the next recording, MB of 2^20 bytes: what is free and what older ones would leave.
  /// Errors: kIo.
  [[nodiscard]] core::Result<std::int64_t> room_mb();

  /// The recording begun last: its path without ending.
  [[nodiscard]] const std::string& path() const { return path_; }

  /// Why the last call failed, in one line.
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  struct Files {
    AtomicFile meta;
    AtomicFile events;
    AtomicFile session;
    AtomicFile state;
    Y4mWriter video;
  };

  [[nodiscard]] core::Result<void> open_files(const hal::RecordingHead& head);
  [[nodiscard]] core::Result<void> write_frame();
  [[nodiscard]] core::Result<void> put_in_place();
  template <typename File>
  [[nodiscard]] core::Result<void> checked(core::Result<void> result, const File& file);
  [[nodiscard]] core::Result<void> given_up(core::Result<void> result);

  RecordingFolder folder_;
  std::string session_;
  WallClock wall_clock_;
  std::string path_;
  std::string message_;
  std::optional<Files> files_;
  std::int32_t width_px_ = 0;
  std::int32_t height_px_ = 0;
  std::vector<std::uint8_t> frame_;
  std::optional<std::int64_t> frame_number_;  ///< of the frame in frame_; empty: none yet
  std::string rows_;
};

}  // namespace tubesight::drivers
