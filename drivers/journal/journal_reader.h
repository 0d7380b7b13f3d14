#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/tube_address.h"
#include "drivers/journal/sqlite_database.h"

namespace tubesight::drivers {

/// A row of a journal as it stands in the file (docs/journal.md). What is not known is empty. So is
/// what no box writes: an address beyond 32 bits, an instant outside of the years 1970 to 9999, a
/// time since the boot that is negative or beyond a hundred years.
struct JournalEntry {
  std::int64_t number = 0;
  std::string kind;
  std::string boot_id;
  std::optional<std::int64_t> monotonic_us;
  std::optional<std::int64_t> wall_us;
  std::optional<std::int64_t> wall_doubt_us;
  std::string version;
  std::string origin;
  std::optional<std::int64_t> event_id;
  std::optional<core::TubeAddress> claimed;
  std::string verdict;
  std::string reason;
  std::optional<core::TubeAddress> tube;
  std::optional<std::int64_t> offset_um;
  std::optional<std::int64_t> height_um;
  std::optional<std::int64_t> margin_permyriad;
  std::optional<std::int64_t> residual_millipx;
  std::optional<std::int64_t> field;
  std::string field_digest;
  std::string camera_id;
  std::string tool_id;
  std::string base_id;
  std::optional<std::int64_t> first_us;
  std::optional<std::int64_t> last_us;
  std::int64_t count = 1;
  std::string picture_digest;
  std::string detail;
  std::string chain;

  /// The value of a `key=value` word of `detail`; empty where there is none.
  [[nodiscard]] std::string detail_word(std::string_view key) const;
};

/// Reads a journal row by row; it may be open elsewhere, and is never changed. Whether what it says
/// is what was written is check_journal()'s to find out.
class JournalReader {
 public:
  /// Errors: kIo the file cannot be read, kDataLoss it is no journal; message() says why.
  [[nodiscard]] core::Result<void> open(const std::string& path);

  /// Calls `each` for every row up to the number `last`, in their order. Errors: as open(), where
  /// the file is damaged.
  [[nodiscard]] core::Result<void> read(std::int64_t last,
                                        const std::function<void(const JournalEntry&)>& each);

  /// The JPEG file of that digest; empty where it is not kept any more, or is not the one that the
  /// digest is of.
  [[nodiscard]] std::vector<std::byte> picture(const std::string& digest);

  /// The last failure, in one line with the file's name.
  [[nodiscard]] const std::string& message() const { return database_.message(); }

 private:
  SqliteDatabase database_;
};

}  // namespace tubesight::drivers
