#include "core/base/overflow.h"

namespace tubesight::core {
namespace {

// A number has no object to report to; one flag a thread keeps two sessions apart.
constinit thread_local bool g_overflowed = false;

}  // namespace

bool take_overflow_flag() {
  const bool raised = g_overflowed;
  g_overflowed = false;
  return raised;
}

void raise_overflow_flag() { g_overflowed = true; }

}  // namespace tubesight::core
