#include "drivers/settings/table_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"

namespace tubesight::drivers {
namespace {

constexpr WholeRange kAnyWhole{std::numeric_limits<std::int32_t>::min(),
                               std::numeric_limits<std::int32_t>::max()};

std::string expected_text(const NumberRange& range) {
  return "a number from " + number_text(range.least) + " to " + number_text(range.most) +
         range.unit;
}

std::string expected_text(const WholeRange& range) {
  return "an integer from " + std::to_string(range.least) + " to " + std::to_string(range.most);
}

/// NaN lies in no range.
bool read_number(const toml::node& node, const NumberRange& range, double& value) {
  const auto number = node.value<double>();
  if (!node.is_number() || !number || !(*number >= range.least && *number <= range.most)) {
    return false;
  }
  value = *number;
  return true;
}

bool read_whole(const toml::node& node, const WholeRange& range, std::int32_t& value) {
  const auto* const number = node.as_integer();
  if (number == nullptr || number->get() < range.least || number->get() > range.most) {
    return false;
  }
  value = static_cast<std::int32_t>(number->get());
  return true;
}

}  // namespace

std::string describe(const toml::node& node) {
  if (const auto* const text = node.as_string()) {
    return "the text " + in_quotes(text->get());
  }
  if (const auto* const number = node.as_integer()) {
    return std::to_string(number->get());
  }
  if (const auto* const number = node.as_floating_point()) {
    // So that it differs from the integer in "expected an integer".
    std::string text = number_text(number->get());
    return text + (text.find_first_of(".enif") == std::string::npos ? ".0" : "");
  }
  if (const auto* const truth = node.as_boolean()) {
    return truth->get() ? "true" : "false";
  }
  if (const auto* const list = node.as_array()) {
    return "a list of " + std::to_string(list->size());
  }
  return node.is_table() ? "a table" : "a date or time";
}

bool read_address(const toml::node& node, core::TubeAddress& address) {
  const auto* const pair = node.as_array();
  return pair != nullptr && pair->size() == 2 && read_whole((*pair)[0], kAnyWhole, address.row) &&
         read_whole((*pair)[1], kAnyWhole, address.column);
}

std::string why_no_address(const toml::node& node) {
  constexpr const char* kExpected = ", expected [row, column]";
  const auto* const pair = node.as_array();
  if (pair == nullptr || pair->size() != 2) {
    return describe(node) + kExpected;
  }
  core::TubeAddress ignored;
  const bool row = read_whole((*pair)[0], kAnyWhole, ignored.row);
  return "the " + std::string(row ? "column " : "row ") + describe((*pair)[row ? 1 : 0]) +
         kExpected + ", each " + expected_text(kAnyWhole);
}

TableReader::TableReader(const toml::table& table, SettingsPlace place, std::string name,
                         SettingsProblems& problems)
    : table_(&table), place_(place), name_(std::move(name)), problems_(&problems) {}

bool TableReader::has(std::string_view key) const { return table_->contains(key); }

void TableReader::ignore(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
    known_.emplace_back(key);
  }
}

bool TableReader::whole(std::string_view key, WholeRange range, std::int32_t& value) {
  const std::string expected = expected_text(range);
  const toml::node* const node = get(key, expected);
  if (node == nullptr) {
    return false;
  }
  const bool good = read_whole(*node, range, value);
  if (!good) {
    complain(key, describe(*node) + ", expected " + expected);
  }
  return good;
}

bool TableReader::number(std::string_view key, NumberRange range, double& value) {
  const std::string expected = expected_text(range);
  const toml::node* const node = get(key, expected);
  if (node == nullptr) {
    return false;
  }
  const bool good = read_number(*node, range, value);
  if (!good) {
    complain(key, describe(*node) + ", expected " + expected);
  }
  return good;
}

bool TableReader::numbers(std::string_view key, NumberRange range, std::span<double> values) {
  const std::string expected = std::to_string(values.size()) + " times " + expected_text(range);
  const toml::node* const node = get(key, expected);
  if (node == nullptr) {
    return false;
  }
  const auto* const list = node->as_array();
  if (list == nullptr || list->size() != values.size()) {
    complain(key, describe(*node) + ", expected " + expected);
    return false;
  }
  std::vector<double> read(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!read_number((*list)[i], range, read[i])) {
      complain_entry(key, i, (*list)[i],
                     describe((*list)[i]) + ", expected " + expected_text(range));
      return false;
    }
  }
  std::copy(read.begin(), read.end(), values.begin());
  return true;
}

bool TableReader::wholes(std::string_view key, WholeRange range, std::span<std::int32_t> values) {
  const std::string expected = std::to_string(values.size()) + " times " + expected_text(range);
  const toml::node* const node = get(key, expected);
  if (node == nullptr) {
    return false;
  }
  const auto* const list = node->as_array();
  if (list == nullptr || list->size() != values.size()) {
    complain(key, describe(*node) + ", expected " + expected);
    return false;
  }
  std::vector<std::int32_t> read(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!read_whole((*list)[i], range, read[i])) {
      complain_entry(key, i, (*list)[i],
                     describe((*list)[i]) + ", expected " + expected_text(range));
      return false;
    }
  }
  std::copy(read.begin(), read.end(), values.begin());
  return true;
}

bool TableReader::text(std::string_view key, std::string& value) {
  const toml::node* const node = get(key, "a text in quotation marks");
  if (node == nullptr) {
    return false;
  }
  const auto* const text = node->as_string();
  if (text == nullptr) {
    complain(key, describe(*node) + ", expected a text in quotation marks");
    return false;
  }
  value = text->get();
  return true;
}

bool TableReader::word(std::string_view key, std::span<const std::string_view> words,
                       std::size_t& index) {
  std::string expected;
  for (const std::string_view candidate : words) {
    expected += (expected.empty() ? "\"" : " or \"") + std::string(candidate) + "\"";
  }
  const toml::node* const node = get(key, expected);
  if (node == nullptr) {
    return false;
  }
  const auto* const text = node->as_string();
  const auto found =
      text == nullptr ? words.end() : std::find(words.begin(), words.end(), text->get());
  if (found == words.end()) {
    complain(key, describe(*node) + ", expected " + expected);
    return false;
  }
  index = static_cast<std::size_t>(found - words.begin());
  return true;
}

bool TableReader::optional_whole(std::string_view key, WholeRange range, std::int32_t& value) {
  return absent(key) || whole(key, range, value);
}

bool TableReader::optional_number(std::string_view key, NumberRange range, double& value) {
  return absent(key) || number(key, range, value);
}

bool TableReader::optional_numbers(std::string_view key, NumberRange range,
                                   std::span<double> values) {
  return absent(key) || numbers(key, range, values);
}

bool TableReader::optional_wholes(std::string_view key, WholeRange range,
                                  std::span<std::int32_t> values) {
  return absent(key) || wholes(key, range, values);
}

bool TableReader::optional_text(std::string_view key, std::string& value) {
  return absent(key) || text(key, value);
}

bool TableReader::optional_texts(std::string_view key, std::vector<std::string>& values) {
  const toml::array* const entries = list(key, false, "a list of texts");
  if (entries == nullptr) {
    return sound(key);
  }
  values.clear();
  for (std::size_t i = 0; i < entries->size(); ++i) {
    const auto text = (*entries)[i].value_exact<std::string>();
    if (!text) {
      complain_entry(key, i, (*entries)[i], describe((*entries)[i]) + ", expected a text");
      return false;
    }
    values.push_back(*text);
  }
  return true;
}

bool TableReader::optional_word(std::string_view key, std::span<const std::string_view> words,
                                std::size_t& index) {
  return absent(key) || word(key, words, index);
}

bool TableReader::optional_switch(std::string_view key, bool& value) {
  if (absent(key)) {
    return true;
  }
  const toml::node* const node = get(key, "true or false");
  const auto* const truth = node->as_boolean();
  if (truth == nullptr) {
    complain(key, describe(*node) + ", expected true or false");
    return false;
  }
  value = truth->get();
  return true;
}

bool TableReader::address(std::string_view key, core::TubeAddress& value) {
  const toml::node* const node = get(key, "[row, column]");
  if (node == nullptr) {
    return false;
  }
  const bool good = read_address(*node, value);
  if (!good) {
    complain(key, why_no_address(*node));
  }
  return good;
}

const toml::array* TableReader::list(std::string_view key, bool needed, const char* expected) {
  if (!needed && !has(key)) {
    ignore(key);
    return nullptr;
  }
  const toml::node* const node = get(key, expected);
  if (node == nullptr) {
    return nullptr;
  }
  if (!node->is_array()) {
    complain(key, describe(*node) + ", expected " + expected);
  }
  return node->as_array();
}

void TableReader::finish() {
  for (const auto& [key, node] : *table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) {
      continue;
    }
    std::string expected;
    for (const std::string& candidate : known_) {
      expected += (expected.empty() ? "" : ", ") + candidate;
    }
    problems_->push_back(
        {{place_.file, std::max<std::int64_t>(1, key.source().begin.line)},
         path(printable(key.str())) + ": unknown key, expected one of " + expected});
  }
}

void TableReader::complain(std::string_view key, const std::string& text) {
  wrong_.emplace_back(key);
  problems_->push_back({place_of(key), path(key) + ": " + text});
}

void TableReader::complain_entry(std::string_view key, std::size_t index, const toml::node& entry,
                                 const std::string& text) {
  wrong_.emplace_back(key);
  problems_->push_back({place_of(entry), path(key) + "[" + std::to_string(index) + "]: " + text});
}

bool TableReader::sound(std::string_view key) const {
  return std::find(wrong_.begin(), wrong_.end(), key) == wrong_.end();
}

SettingsPlace TableReader::place_of(std::string_view key) const {
  SettingsPlace place = place_;
  for (const auto& [candidate, node] : *table_) {
    if (candidate.str() == key) {
      place.line = std::max<std::int64_t>(1, candidate.source().begin.line);
    }
  }
  return place;
}

SettingsPlace TableReader::place_of(const toml::node& node) const {
  const auto line = static_cast<std::int64_t>(node.source().begin.line);
  return {place_.file, line > 0 ? line : place_.line};
}

bool TableReader::absent(std::string_view key) {
  ignore(key);
  return !has(key);
}

const toml::node* TableReader::get(std::string_view key, const std::string& expected) {
  ignore(key);
  const toml::node* const node = table_->get(key);
  if (node == nullptr) {
    wrong_.emplace_back(key);
    problems_->push_back({place_, path(key) + ": missing, expected " + expected});
  }
  return node;
}

std::string TableReader::path(std::string_view key) const { return name_ + "." + std::string(key); }

}  // namespace tubesight::drivers
