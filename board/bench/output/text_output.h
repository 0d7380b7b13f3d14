#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tubesight::board {

/// How much the program says beside its messages: `-q` and `-v` of every command.
enum class Talk : std::uint8_t {
  kQuiet,  ///< neither results for people nor progress
  kUsual,
  kVerbose,  ///< also what is read, and how
};

/// Says how much, once, before a command runs; kUsual until then.
void set_talk(Talk talk);
[[nodiscard]] Talk talk();

/// Messages for a person, a line each, to standard error; a progress line there is erased before.
void tell(const std::string& message);
void tell(const std::vector<std::string>& messages);

/// A message that `-v` alone asks for.
void tell_more(const std::string& message);

/// With `-v`, which files settings were read from: their own, and those that it includes.
void tell_files(const std::vector<std::string>& files);

/// Writes results for a person to standard output, or to standard error where `taken`: an output of
/// the command goes to standard output. With `-q` nowhere. Says false, and why to standard error,
/// when they did not get there.
[[nodiscard]] bool write_out(const std::string& text, bool taken = false);

}  // namespace tubesight::board
