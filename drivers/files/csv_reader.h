#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/files/messages.h"

namespace tubesight::drivers {

/// Walks through the lines of a CSV text that is kept by the caller.
///
/// Cells are separated by commas; a cell in double quotes may hold commas and doubled quotes, but
/// no line feed. Lines end in LF or CRLF; a byte-order mark and empty lines are passed over.
class CsvReader {
 public:
  /// `name` stands before every message.
  CsvReader(std::string_view text, std::string name);

  /// Reads the header and checks that it begins with `columns`, in their order; what follows them
  /// is accepted. False, with one message, when it does not.
  [[nodiscard]] bool read_header(const std::vector<std::string_view>& columns, Messages& messages);

  /// Moves to the next line that holds something; false at the end. A line with a broken quotation
  /// gives a message and is passed over.
  [[nodiscard]] bool next(Messages& messages);

  /// The cells of the current line.
  [[nodiscard]] const std::vector<std::string>& cells() const { return cells_; }

  /// Cells that the header has.
  [[nodiscard]] std::size_t columns() const { return columns_; }

  /// Number of the current line, from 1.
  [[nodiscard]] std::int64_t line_number() const { return line_number_; }

  /// "name:line: ", to begin a message about the current line.
  [[nodiscard]] std::string place() const;

 private:
  bool split(std::string_view line);

  std::string_view rest_;
  std::string name_;
  std::int64_t line_number_ = 0;
  std::size_t columns_ = 0;
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
