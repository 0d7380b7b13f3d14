#pragma once

#include <cstdint>

namespace tubesight::tests {

/// Calls for memory since the guard was armed, by either route.
struct HeapCalls {
  std::int64_t allocations = 0;  ///< operator new and the malloc family
  std::int64_t releases = 0;     ///< operator delete and free, null pointers left out
};

/// Whose calls a guard counts.
enum class HeapScope : std::uint8_t {
  kAllThreads,
  kThisThread,  ///< the one that makes the guard: others may allocate beside it
};

/// Counts every call for memory, by all threads unless told otherwise, from construction to
/// destruction.
///
/// Linking tubesight::heap_guard replaces operator new and delete in the whole program and wraps
/// the malloc family in its own objects and archives. Calls made inside shared libraries are seen
/// only when they go through operator new. One guard at a time; arming a second one stops the
/// program. Read the counts before an EXPECT: GoogleTest allocates.
class HeapGuard {
 public:
  explicit HeapGuard(HeapScope scope = HeapScope::kAllThreads);
  ~HeapGuard();
  HeapGuard(const HeapGuard&) = delete;
  HeapGuard& operator=(const HeapGuard&) = delete;

  /// The counts up to now.
  [[nodiscard]] HeapCalls calls() const;
};

}  // namespace tubesight::tests
