#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/pose_pair.h"
#include "core/base/result.h"

namespace tubesight::drivers {

/// The columns that every PAIRS.csv has, in their order (docs/file-formats.md); joint_1_deg and so
/// on may follow.
[[nodiscard]] const std::vector<std::string_view>& pair_columns();

/// What stands in a file of pairs, as far as a further row needs it.
class PairsText {
 public:
  /// Rows that a file may have: what `calibrate base` takes.
  static constexpr std::int32_t kMostRows = 256;

  /// Takes over what a file has; empty: there is none yet. False, and why in one line with the
  /// place, where that is no file of pairs; then nothing is to be appended.
  [[nodiscard]] bool begin(std::string text, const std::string& name, std::string& message);

  /// Appends a row, and before the first one the header, with as many joints as that pair has. Its
  /// name counts on from the last "pN". False, and why, where the file is full or has another
  /// number of joints.
  [[nodiscard]] bool append(const core::PosePair& pair, std::string& message);

  /// All of it; where there is no row, the header for rows without joints.
  [[nodiscard]] std::string text() const;

 private:
  std::string text_;
  std::string name_;
  std::int32_t rows_ = 0;
  std::int32_t joints_ = -1;  ///< columns; below 0: there is no header yet
  std::int64_t last_ = 0;     ///< largest N of the names "pN"
};

/// Why what stands there is no file of pairs, in one line; empty where it is one, or nothing is
/// there.
[[nodiscard]] std::string why_no_pairs(const std::string& path);

/// Appends a pair to the file of that name, which is made where there is none. The file is replaced
/// by a whole one, so that whatever happens it has whole rows alone; when this returns the row is
/// there after a power cut, too. As slow as the disk.
///
/// Errors: kInvalidArgument what stands there is no file of pairs, or the pair doesn't fit it; kIo
/// it cannot be read or written, or is not known to be on the disk (AtomicFile::commit_to_disk()).
/// The file is then as it was, but for that last case, and `message` says why in one line.
[[nodiscard]] core::Result<void> append_pair(const std::string& path, const core::PosePair& pair,
                                             std::string& message);

}  // namespace tubesight::drivers
