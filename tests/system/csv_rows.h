#pragma once

#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace tubesight::tests {

/// A line of a CSV file by the names of its columns.
using Row = std::map<std::string, std::string>;

/// Lines of a CSV text without quotation marks, by the names of its first line.
inline std::vector<Row> read_rows(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::vector<std::string> names;
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    std::vector<std::string> cells;
    std::string cell;
    for (const char c : line + ",") {
      if (c == ',') {
        cells.push_back(cell);
        cell.clear();
      } else {
        cell += c;
      }
    }
    if (names.empty()) {
      names = cells;
      continue;
    }
    Row row;
    for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i) {
      row[names[i]] = cells[i];
    }
    rows.push_back(row);
  }
  return rows;
}

/// A cell as a number; 0 for an empty one.
inline double number(const Row& row, const std::string& name) {
  return std::atof(row.at(name).c_str());
}

}  // namespace tubesight::tests
