#include "core/base/assert.h"

namespace tubesight::core {
namespace {

// The one piece of program-wide state in core: a failed assertion has no object to ask.
constinit PanicHook g_panic_hook = nullptr;

}  // namespace

void set_panic_hook(PanicHook hook) { g_panic_hook = hook; }

void panic(const char* expression, const char* file, int line) {
  if (g_panic_hook != nullptr) {
    g_panic_hook(expression, file, line);
  }
  __builtin_trap();
}

}  // namespace tubesight::core
