#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/settings.h"
#include "drivers/files/messages.h"
#include "drivers/settings/session_tables.h"
#include "drivers/settings/text_files.h"

namespace tubesight::drivers {

/// How a template's lines of dots stand.
enum class DotLattice : std::uint8_t { kSquare, kStaggered };

/// A template of dots; the table `[target]`.
struct TargetSettings {
  std::int32_t rows = 0;     ///< lines of dots
  std::int32_t columns = 0;  ///< dots in a line
  DotLattice lattice = DotLattice::kSquare;
  double spacing_mm = 0.0;      ///< along a line
  double row_spacing_mm = 0.0;  ///< between lines; as read never 0
  double dot_mm = 0.0;          ///< diameter; 0: points without one
  bool bright = true;           ///< bright on dark
  double lens_mm = 0.0;         ///< EFL by the lens' data sheet; 0: not said
};

/// A view of it; a table of `[[view]]`. Either images or a points file.
struct ViewSettings {
  std::vector<std::string> images;  ///< paths, as from here
  std::string points;
  bool staged = false;  ///< on the translation stage, at `height_mm`
  double height_mm = 0.0;
};

/// A calibration target's file.
struct TargetFile {
  core::CameraSettings camera;  ///< what is known beforehand: size, scan, cells, columns
  CalibrationQuality device;    ///< which camera it is: serial and model, where they are said
  TargetSettings target;
  std::vector<ViewSettings> views;
};

/// Reads a calibration target's file. Errors: kInvalidArgument; all mistakes are in `messages`.
[[nodiscard]] core::Result<void> load_target(const std::string& path, TargetFile& file,
                                             Messages& messages);
[[nodiscard]] core::Result<void> load_target(TextFiles& files, const std::string& path,
                                             TargetFile& file, Messages& messages);

/// A target's file whose views read points in place of pictures: the names of the points files as
/// they stand beside it, one a view.
[[nodiscard]] std::string target_text(const TargetFile& file,
                                      const std::vector<std::string>& points);

}  // namespace tubesight::drivers
