// expect: ignoring returned value of type .*Result<int>.*nodiscard
// A result with a value is not dropped.
#include "core/base/result.h"

tubesight::core::Result<int> count_tubes();

void run() {
#ifdef TUBESIGHT_MUST_NOT_COMPILE
  count_tubes();
#else
  (void)count_tubes();
#endif
}
