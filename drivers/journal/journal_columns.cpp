#include "drivers/journal/journal_columns.h"

#include <chrono>
#include <optional>

#include "drivers/journal/journal_digest.h"

namespace tubesight::drivers {
namespace {

/// How many bytes a UTF-8 sequence has by its first one; 0: it cannot begin one.
std::size_t length_of_sequence(unsigned char first) {
  if (first < 0x80) {
    return 1;
  }
  if (first >= 0xc2 && first < 0xe0) {
    return 2;
  }
  if (first >= 0xe0 && first < 0xf0) {
    return 3;
  }
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

/// Other programs read the file, and not all of them forgive text that is none.
std::string clean(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t length = length_of_sequence(first);
    bool sound = length != 0 && i + length <= text.size() && first >= 0x20 && first != 0x7f;
    for (std::size_t k = 1; sound && k < length; ++k) {
      sound = (static_cast<unsigned char>(text[i + k]) & 0xc0U) == 0x80U;
    }
    result += sound ? text.substr(i, length) : std::string_view("?");
    i += sound ? length : 1;
  }
  return result;
}

JournalCell cell(std::string_view text) {
  return text.empty() ? JournalCell() : JournalCell(clean(text));
}

template <typename T>
JournalCell cell(const std::optional<T>& number) {
  return number ? JournalCell(std::int64_t{*number}) : JournalCell();
}

template <typename Period>
JournalCell cell(const std::optional<std::chrono::duration<std::int64_t, Period>>& time) {
  return time ? JournalCell(std::int64_t{
                    std::chrono::duration_cast<std::chrono::microseconds>(*time).count()})
              : JournalCell();
}

std::optional<std::int32_t> row_of(const std::optional<core::TubeAddress>& tube) {
  return tube ? std::optional(tube->row) : std::nullopt;
}

std::optional<std::int32_t> column_of(const std::optional<core::TubeAddress>& tube) {
  return tube ? std::optional(tube->column) : std::nullopt;
}

}  // namespace

std::string chain_before_first() { return std::string(64, '0'); }

JournalCells cells_of(const hal::JournalRow& row, std::int64_t number,
                      const std::string& picture_digest) {
  return {std::int64_t{number},
          cell(hal::name_of(row.kind)),
          cell(row.time.boot_id),
          std::int64_t{row.time.monotonic.count()},
          cell(row.time.wall),
          cell(row.time.wall_doubt),
          cell(row.version),
          cell(row.origin),
          cell(row.event_id),
          cell(row_of(row.claimed)),
          cell(column_of(row.claimed)),
          cell(row.verdict),
          cell(row.reason),
          cell(row_of(row.seen.tube)),
          cell(column_of(row.seen.tube)),
          cell(row.seen.offset_um),
          cell(row.seen.height_um),
          cell(row.seen.margin_permyriad),
          cell(row.seen.residual_millipx),
          cell(row.seen.field),
          cell(row.seen.field_time),
          cell(row.seen.field_digest),
          cell(row.camera_id),
          cell(row.tool_id),
          cell(row.base_id),
          cell(row.first),
          cell(row.last),
          std::int64_t{row.count},
          cell(std::string_view(picture_digest)),
          cell(row.detail)};
}

std::string canonical_text(std::string_view chain_before, std::span<const JournalCell> cells) {
  std::string text(chain_before);
  for (const JournalCell& value : cells) {
    if (const auto* const number = std::get_if<std::int64_t>(&value)) {
      const std::string decimal = std::to_string(*number);
      text += std::to_string(decimal.size()) + ":" + decimal + ",";
    } else if (const auto* const words = std::get_if<std::string>(&value)) {
      text += std::to_string(words->size()) + ":" + *words + ",";
    } else {
      text += "-,";
    }
  }
  return text;
}

std::string chain_of(std::string_view chain_before, std::span<const JournalCell> cells) {
  return sha256_hex(std::string_view(canonical_text(chain_before, cells)));
}

std::string checkpoint_text(std::int64_t number, std::string_view chain) {
  return "tubesight journal checkpoint\n" + std::to_string(number) + "\n" + std::string(chain) +
         "\n";
}

}  // namespace tubesight::drivers
