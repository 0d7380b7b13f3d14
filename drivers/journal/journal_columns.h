#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "hal/journal.h"

namespace tubesight::drivers {

/// What stands in a cell; the first is "not known", NULL in the file.
using JournalCell = std::variant<std::monostate, std::int64_t, std::string>;

/// A column of the table `journal`.
struct JournalColumn {
  std::string_view name;
  bool is_text = false;  ///< TEXT, and else INTEGER
};

/// All columns but the last, `chain`, in their order, which the chain is reckoned in. Columns may
/// come, behind these and with another number of the format; none ever changes.
inline constexpr std::array kJournalColumns = std::to_array<JournalColumn>({
    {"n"},
    {"kind", true},
    {"boot_id", true},
    {"monotonic_us"},
    {"wall_us"},
    {"wall_doubt_us"},
    {"version", true},
    {"origin", true},
    {"event_id"},
    {"claim_row"},
    {"claim_column"},
    {"verdict", true},
    {"reason", true},
    {"tube_row"},
    {"tube_column"},
    {"offset_um"},
    {"height_um"},
    {"margin_permyriad"},
    {"residual_millipx"},
    {"field"},
    {"field_us"},
    {"field_digest", true},
    {"camera_id", true},
    {"tool_id", true},
    {"base_id", true},
    {"first_us"},
    {"last_us"},
    {"count"},
    {"picture_digest", true},
    {"detail", true},
});

using JournalCells = std::array<JournalCell, kJournalColumns.size()>;

/// What the first row is chained to.
[[nodiscard]] std::string chain_before_first();

/// The cells of a row with its number; `picture_digest` empty: there is no picture.
[[nodiscard]] JournalCells cells_of(const hal::JournalRow& row, std::int64_t number,
                                    const std::string& picture_digest);

/// The bytes that a row's digest is of (docs/journal.md): the chain of the row before and then each
/// cell in the columns' order, "-," where it is not known, and else LENGTH:BYTES, with the length
/// in bytes and integers in decimal.
[[nodiscard]] std::string canonical_text(std::string_view chain_before,
                                         std::span<const JournalCell> cells);

/// SHA-256 of that, as 64 hexadecimal digits: the column `chain`.
[[nodiscard]] std::string chain_of(std::string_view chain_before,
                                   std::span<const JournalCell> cells);

/// What a checkpoint's signature is of: everything up to the row `number`, whose chain that is.
[[nodiscard]] std::string checkpoint_text(std::int64_t number, std::string_view chain);

}  // namespace tubesight::drivers
