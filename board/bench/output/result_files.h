#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/image_view.h"
#include "core/base/result.h"
#include "core/base/sighting.h"
#include "core/tracking/tracker.h"
#include "drivers/files/atomic_file.h"

namespace tubesight::board {

/// The files `--fields` and `--centers` of a replay; either may be left out.
///
/// They appear under their names when commit() succeeds, and not before. Errors are kIo, and
/// message() tells in one line.
class ResultFiles {
 public:
  /// Begins the files; an empty path leaves one out, and "-" is standard output.
  [[nodiscard]] core::Result<void> open(const std::string& fields, const std::string& centers);

  /// Appends the row of a field and those of its measured tube-ends. Recognised plugs are no
  /// tube-ends measured and have no row.
  [[nodiscard]] core::Result<void> add(std::int64_t field, core::Parity parity,
                                       const core::Sighting& sighting,
                                       const core::tracking::TubeSightingList& tubes);

  /// Puts the files in their places.
  [[nodiscard]] core::Result<void> commit();

  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  core::Result<void> begin(drivers::AtomicFile& file, const std::string& path,
                           std::string_view header);
  core::Result<void> append(drivers::AtomicFile& file, const std::string& rows);
  core::Result<void> finish(drivers::AtomicFile& file);

  drivers::AtomicFile fields_;
  drivers::AtomicFile centers_;
  std::string rows_;  ///< reused from field to field
  std::string message_;
};

}  // namespace tubesight::board
