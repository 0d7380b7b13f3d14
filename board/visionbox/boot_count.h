#pragma once

#include <cstdint>
#include <string>

namespace tubesight::board {

/// Which start of the machine this is, and which start of the program since: what orders logs and
/// recordings of a box whose clock stands at the same day after each power cut.
struct BootCount {
  std::int64_t boot = 0;   ///< from 1; 0: not known
  std::int64_t start = 0;  ///< from 1 in each boot; 0: not known
  bool wanted = false;     ///< there is a folder to count them in
  std::string trouble;     ///< why they are not known; empty: they are

  [[nodiscard]] bool known() const { return boot > 0; }
  /// "boot 17, start 2", or "boots are not numbered: ...".
  [[nodiscard]] std::string words() const;
};

/// The kernel's own name of this start of the machine, another one at each.
inline constexpr const char* kBootIdFile = "/proc/sys/kernel/random/boot_id";

/// That name; empty: it cannot be read.
[[nodiscard]] std::string kernel_boot_id(const std::string& boot_id_file = kBootIdFile);

/// Counts one more start in the file `boots` of this folder, which a power cut leaves old or new.
///
/// A number that cannot be written down is not used: after the next start it would be given again.
/// A damaged file is left as it is, for the same reason. `folder` empty: there is none.
[[nodiscard]] BootCount count_boot(const std::string& folder,
                                   const std::string& boot_id_file = kBootIdFile);

}  // namespace tubesight::board
