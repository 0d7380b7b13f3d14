#pragma once

namespace tubesight::core {

/// Called when a TUBESIGHT_ASSERT fails; puts lamp and robot link in their safe state. It must not
/// return: if it does, the program traps.
using PanicHook = void (*)(const char* expression, const char* file, int line);

/// Installs the board's panic hook; nullptr restores the default, which only traps.
///
/// Call it once, before any thread runs.
void set_panic_hook(PanicHook hook);

/// Reports a broken programmer's contract; never returns.
[[noreturn]] void panic(const char* expression, const char* file, int line);

}  // namespace tubesight::core

/// Checks a programmer's contract in all builds. Data from wires and files is validated instead.
#define TUBESIGHT_ASSERT(condition) \
  ((condition) ? static_cast<void>(0) : ::tubesight::core::panic(#condition, __FILE__, __LINE__))
