#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>

#include "drivers/settings/table_reader.h"
#include "drivers/settings/toml_writer.h"

namespace tubesight::drivers {

// The keys of a table of a settings file: a name, what it may hold, and the member of a struct that
// it stands for. A list of them (a std::array or, of several kinds, a std::tuple) serves both the
// reader and the writer of the table, so that what is read is written and comes back as it was. The
// struct's own value is the default of a key left out.

/// Whether a key must be in the table.
enum class Need : std::uint8_t { kOptional, kNeeded };

template <typename Struct>
struct NumberKey {
  std::string_view key;
  NumberRange range;
  double Struct::*member;
  Need need = Need::kOptional;
  std::optional<double> unset{};  ///< a value that stands for the key's absence: not written
};

template <typename Struct>
struct WholeKey {
  std::string_view key;
  WholeRange range;
  std::int32_t Struct::*member;
  Need need = Need::kOptional;
  std::optional<std::int32_t> unset{};
};

template <typename Struct, std::size_t N>
struct NumbersKey {
  std::string_view key;
  NumberRange range;
  std::array<double, N> Struct::*member;
  Need need = Need::kOptional;
};

template <typename Struct, std::size_t N>
struct WholesKey {
  std::string_view key;
  WholeRange range;
  std::array<std::int32_t, N> Struct::*member;
  Need need = Need::kOptional;
};

/// One of `words`, which stand in the order of the enumerators.
template <typename Struct, typename Enum>
struct WordKey {
  std::string_view key;
  std::span<const std::string_view> words;
  Enum Struct::*member;
  Need need = Need::kOptional;
};

/// true or false
template <typename Struct>
struct SwitchKey {
  std::string_view key;
  bool Struct::*member;
};

template <typename Struct>
void read_key(TableReader& table, const NumberKey<Struct>& key, Struct& values) {
  if (key.need == Need::kNeeded) {
    table.number(key.key, key.range, values.*key.member);
  } else {
    table.optional_number(key.key, key.range, values.*key.member);
  }
}

template <typename Struct>
void read_key(TableReader& table, const WholeKey<Struct>& key, Struct& values) {
  if (key.need == Need::kNeeded) {
    table.whole(key.key, key.range, values.*key.member);
  } else {
    table.optional_whole(key.key, key.range, values.*key.member);
  }
}

template <typename Struct, std::size_t N>
void read_key(TableReader& table, const NumbersKey<Struct, N>& key, Struct& values) {
  if (key.need == Need::kNeeded) {
    table.numbers(key.key, key.range, values.*key.member);
  } else {
    table.optional_numbers(key.key, key.range, values.*key.member);
  }
}

template <typename Struct, std::size_t N>
void read_key(TableReader& table, const WholesKey<Struct, N>& key, Struct& values) {
  if (key.need == Need::kNeeded) {
    table.wholes(key.key, key.range, values.*key.member);
  } else {
    table.optional_wholes(key.key, key.range, values.*key.member);
  }
}

template <typename Struct, typename Enum>
void read_key(TableReader& table, const WordKey<Struct, Enum>& key, Struct& values) {
  auto index = static_cast<std::size_t>(values.*key.member);
  if (key.need == Need::kNeeded) {
    table.word(key.key, key.words, index);
  } else {
    table.optional_word(key.key, key.words, index);
  }
  values.*key.member = static_cast<Enum>(index);
}

template <typename Struct>
void read_key(TableReader& table, const SwitchKey<Struct>& key, Struct& values) {
  table.optional_switch(key.key, values.*key.member);
}

template <typename Struct>
void write_key(TomlWriter& toml, const NumberKey<Struct>& key, const Struct& values) {
  if (values.*key.member != key.unset) {
    toml.number(key.key, values.*key.member);
  }
}

template <typename Struct>
void write_key(TomlWriter& toml, const WholeKey<Struct>& key, const Struct& values) {
  if (values.*key.member != key.unset) {
    toml.whole(key.key, values.*key.member);
  }
}

template <typename Struct, std::size_t N>
void write_key(TomlWriter& toml, const NumbersKey<Struct, N>& key, const Struct& values) {
  toml.numbers(key.key, values.*key.member);
}

template <typename Struct, std::size_t N>
void write_key(TomlWriter& toml, const WholesKey<Struct, N>& key, const Struct& values) {
  toml.wholes(key.key, values.*key.member);
}

template <typename Struct, typename Enum>
void write_key(TomlWriter& toml, const WordKey<Struct, Enum>& key, const Struct& values) {
  toml.text(key.key, key.words[static_cast<std::size_t>(values.*key.member)]);
}

template <typename Struct>
void write_key(TomlWriter& toml, const SwitchKey<Struct>& key, const Struct& values) {
  toml.truth(key.key, values.*key.member);
}

/// Reads the keys in their order; mistakes go to the reader's problems.
template <typename Keys, typename Struct>
void read_keys(TableReader& table, const Keys& keys, Struct& values) {
  std::apply([&](const auto&... key) { (read_key(table, key, values), ...); }, keys);
}

/// Writes the keys in their order.
template <typename Keys, typename Struct>
void write_keys(TomlWriter& toml, const Keys& keys, const Struct& values) {
  std::apply([&](const auto&... key) { (write_key(toml, key, values), ...); }, keys);
}

/// Accepts the keys whatever they hold, or their absence.
template <typename Keys>
void ignore_keys(TableReader& table, const Keys& keys) {
  std::apply([&](const auto&... key) { (table.ignore(key.key), ...); }, keys);
}

}  // namespace tubesight::drivers
