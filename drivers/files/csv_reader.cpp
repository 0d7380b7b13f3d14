#include "drivers/files/csv_reader.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace tubesight::drivers {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

template <typename T>
bool parse_number(std::string_view text, T& value) {
  T number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    return false;
  }
  value = number;
  return true;
}

}  // namespace

CsvReader::CsvReader(std::string_view text, std::string name)
    : rest_(text), name_(std::move(name)) {
  if (rest_.starts_with(kByteOrderMark)) {
    rest_.remove_prefix(kByteOrderMark.size());
  }
}

bool CsvReader::read_header(const std::vector<std::string_view>& columns, Messages& messages,
                            LastColumn last) {
  std::string expected;
  for (const std::string_view column : columns) {
    expected += expected.empty() ? "" : ",";
    expected += column;
  }
  if (!next(messages)) {
    messages.push_back(name_ + ":1: the header is missing, expected " + expected);
    return false;
  }
  bool same = cells_.size() >= columns.size();
  for (std::size_t i = 0; same && i < columns.size(); ++i) {
    same = cells_[i] == columns[i];
  }
  if (!same) {
    messages.push_back(place() + "wrong header, expected " + expected);
  }
  header_ = cells_;
  last_ = header_.size() == columns.size() ? last : LastColumn::kOneCell;
  return same;
}

std::optional<std::size_t> CsvReader::find_column(std::string_view name) const {
  for (std::size_t i = 0; i < header_.size(); ++i) {
    if (header_[i] == name) {
      return i;
    }
  }
  return std::nullopt;
}

bool CsvReader::next(Messages& messages) {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find('\n');
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_number_;
    if (line.ends_with('\r')) {
      line.remove_suffix(1);
    }
    if (line.empty()) {
      continue;
    }
    if (!split(line)) {
      messages.push_back(place() + "quotation marks do not pair, expected \"...\" around a cell");
    } else if (!fit_to_header()) {
      messages.push_back(place() + std::to_string(cells_.size()) + " cells, expected " +
                         std::to_string(header_.size()));
    } else {
      return true;
    }
    if (messages.size() >= kMostMessages) {
      return false;
    }
  }
  return false;
}

/// Whether the current line has as many cells as the header, once the last column took the rest.
bool CsvReader::fit_to_header() {
  if (last_ == LastColumn::kRest && cells_.size() + 1 == header_.size()) {
    cells_.emplace_back();
  }
  if (last_ == LastColumn::kRest && cells_.size() > header_.size()) {
    std::string& last = cells_[header_.size() - 1];
    for (std::size_t i = header_.size(); i < cells_.size(); ++i) {
      last += ',' + cells_[i];
    }
    cells_.resize(header_.size());
  }
  return header_.empty() || cells_.size() == header_.size();
}

std::string CsvReader::place() const { return name_ + ":" + std::to_string(line_number_) + ": "; }

bool CsvReader::split(std::string_view line) {
  cells_.clear();
  std::size_t i = 0;
  while (true) {
    std::string cell;
    if (i < line.size() && line[i] == '"') {
      ++i;
      while (true) {
        if (i >= line.size()) {
          return false;
        }
        if (line[i] == '"') {
          if (i + 1 >= line.size() || line[i + 1] != '"') {
            break;
          }
          ++i;
        }
        cell += line[i++];
      }
      ++i;
      if (i < line.size() && line[i] != ',') {
        return false;
      }
    } else {
      const std::size_t end = std::min(line.find(',', i), line.size());
      cell = line.substr(i, end - i);
      i = end;
    }
    cells_.push_back(std::move(cell));
    if (i >= line.size()) {
      return true;
    }
    ++i;  // the comma
  }
}

std::string printable(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string result;
  for (const char c : text.substr(0, kLongest)) {
    // Bytes above 127 belong to UTF-8; control characters would garble a terminal.
    const auto byte = static_cast<unsigned char>(c);
    result += byte < 0x20 || byte == 0x7F ? '?' : c;
  }
  return text.size() > kLongest ? result + "..." : result;
}

std::string in_quotes(std::string_view text) { return "'" + printable(text) + "'"; }

bool parse_whole(std::string_view text, std::int64_t& value) { return parse_number(text, value); }
bool parse_whole(std::string_view text, std::int32_t& value) { return parse_number(text, value); }

}  // namespace tubesight::drivers
