#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/field.h"
#include "core/base/result.h"
#include "drivers/files/messages.h"

namespace tubesight::drivers {

/// What a meta file says about one field.
struct FieldMeta {
  std::int64_t field = 0;     ///< number in files
  std::int64_t sequence = 0;  ///< grows; unwrapped; of a missing field that of the row before
  core::FieldTime time{0};    ///< mid-exposure
  core::FieldStatus status = core::FieldStatus::kGood;
  std::optional<std::int32_t> lamp_permille;  ///< level in force, 0..1000
  std::int64_t line = 0;                      ///< where in the file
};

/// The rows of a `NAME.meta.csv`, in the order of their fields.
class ReplayMeta {
 public:
  /// Who wrote the file.
  enum class Writer : std::uint8_t {
    kAnybody,   ///< time and sequence must grow from row to row
    kRecorder,  ///< they are what a box was given, and it may have been given anything
  };

  /// Reads the text of a meta file; `name` stands before every message. All rows are checked, each
  /// by itself and against the one before, and there is a message for each that is wrong (the first
  /// 20). Errors: kInvalidArgument.
  [[nodiscard]] core::Result<void> parse(std::string_view text, const std::string& name,
                                         Messages& messages, Writer writer = Writer::kAnybody);

  /// The rows, by growing field number.
  [[nodiscard]] const std::vector<FieldMeta>& rows() const { return rows_; }

  /// The row of a field, or null. Cost: a binary search.
  [[nodiscard]] const FieldMeta* find(std::int64_t field) const;

 private:
  std::vector<FieldMeta> rows_;
};

}  // namespace tubesight::drivers
