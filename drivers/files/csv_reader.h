#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/files/messages.h"

namespace tubesight::drivers {

/// Walks through the lines of a CSV text that is kept by the caller.
///
/// Cells are separated by commas; a cell in double quotes may hold commas and doubled quotes, but
/// no line feed. Lines end in LF or CRLF; a byte-order mark and empty lines are passed over. Behind
/// a header each line must have as many cells as that: a surplus comma moves all cells behind it.
class CsvReader {
 public:
  /// What the last of the columns that are asked for takes, as long as the header ends with it.
  enum class LastColumn : std::uint8_t {
    kOneCell,
    kRest,  ///< all that is left of the line, commas too; the line may also end before it
  };

  /// Messages that are enough about one file.
  static constexpr std::size_t kMostMessages = 20;

  /// `name` stands before every message.
  CsvReader(std::string_view text, std::string name);

  /// Reads the header and checks that it begins with `columns`, in their order; what follows them
  /// is accepted. False, with one message, when it does not.
  [[nodiscard]] bool read_header(const std::vector<std::string_view>& columns, Messages& messages,
                                 LastColumn last = LastColumn::kOneCell);

  /// Moves to the next line that holds something; false at the end. A line with a broken quotation,
  /// or with more or fewer cells than the header, gives a message and is passed over; false too
  /// when that makes kMostMessages of them.
  [[nodiscard]] bool next(Messages& messages);

  /// The cells of the current line; once the header was read, as many as that has.
  [[nodiscard]] const std::vector<std::string>& cells() const { return cells_; }

  /// How many columns the header has; 0 before it was read.
  [[nodiscard]] std::size_t columns() const { return header_.size(); }

  /// Where the header has the column of that name, from 0; empty when it has none.
  [[nodiscard]] std::optional<std::size_t> find_column(std::string_view name) const;

  /// Number of the current line, from 1.
  [[nodiscard]] std::int64_t line_number() const { return line_number_; }

  /// "name:line: ", to begin a message about the current line.
  [[nodiscard]] std::string place() const;

 private:
  bool split(std::string_view line);
  bool fit_to_header();

  std::string_view rest_;
  std::string name_;
  std::int64_t line_number_ = 0;
  std::vector<std::string> header_;
  LastColumn last_ = LastColumn::kOneCell;
  std::vector<std::string> cells_;
};

/// What came from a file, fit for one line on a terminal: at most 60 bytes, no control characters.
[[nodiscard]] std::string printable(std::string_view text);

/// The same in single quotes.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// Reads a whole number that fits; false, and `value` as it was, for anything else.
[[nodiscard]] bool parse_whole(std::string_view text, std::int64_t& value);
[[nodiscard]] bool parse_whole(std::string_view text, std::int32_t& value);

}  // namespace tubesight::drivers
