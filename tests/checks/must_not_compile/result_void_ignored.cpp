// expect: ignoring returned value of type .*Result<void>.*nodiscard
// Nor is a result that only says whether it went well.
#include "core/base/result.h"

tubesight::core::Result<void> start();

bool run() {
#ifdef TUBESIGHT_MUST_NOT_COMPILE
  start();
  return true;
#else
  return start().has_value();
#endif
}
