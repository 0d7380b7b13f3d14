#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "drivers/journal/journal_check.h"

namespace tubesight::board {

/// How far a journal proves that it is what the box wrote.
enum class Seal : std::uint8_t {
  kSigned,    ///< nothing is wrong, and checkpoints are signed
  kUnsigned,  ///< nothing is wrong, and nothing is signed
  kBroken,    ///< a row, a signature or a picture is not what was written
};

/// A journal that was checked, whatever came of it.
struct SealedJournal {
  std::string path;
  bool key_known = false;  ///< signatures were compared with a key that the user gave
  drivers::JournalCheck check;

  [[nodiscard]] Seal seal() const {
    return check.wrong > 0 ? Seal::kBroken : check.key.empty() ? Seal::kUnsigned : Seal::kSigned;
  }

  /// The last row that a good signature covers, of a journal with nothing wrong; else 0.
  [[nodiscard]] std::int64_t proved_through() const {
    return seal() == Seal::kSigned ? check.signed_through : 0;
  }
};

/// Checks a journal: its chain, its signatures, its pictures. `key_path` is the file of the box's
/// public key, empty where it is not known; `at_least` the rows that it must have. Empty, and why
/// in one line, where the journal or the key cannot be read. A million rows take some seconds.
[[nodiscard]] std::optional<SealedJournal> check_seal(const std::string& path,
                                                      const std::string& key_path,
                                                      std::string& message,
                                                      std::int64_t at_least = 0);

/// What the check came to, in sentences without the file's name: "The chain of 512 rows is whole.
/// ...". The problems themselves are in `check`.
[[nodiscard]] std::string seal_text(const SealedJournal& journal);

/// "1 row", "2 rows".
[[nodiscard]] std::string counted(std::int64_t number, const std::string& what);

}  // namespace tubesight::board
