#include "tests/support/heap_guard.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

enum class Armed : std::uint8_t { kNot, kAllThreads, kOneThread };

std::atomic<Armed> g_armed{Armed::kNot};
thread_local bool t_watched = false;
std::atomic<std::int64_t> g_allocations{0};
std::atomic<std::int64_t> g_releases{0};

void count(std::atomic<std::int64_t>& counter) {
  const Armed armed = g_armed.load(std::memory_order_relaxed);
  if (armed == Armed::kAllThreads || (armed == Armed::kOneThread && t_watched)) {
    counter.fetch_add(1, std::memory_order_relaxed);
  }
}

void count_release(const void* pointer) {
  if (pointer != nullptr) {
    count(g_releases);
  }
}

}  // namespace

// The linker's --wrap sends each call of NAME to __wrap_NAME and offers the real one as
// __real_NAME.
extern "C" {

void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t number, std::size_t size);
void* __real_realloc(void* pointer, std::size_t size);
void* __real_aligned_alloc(std::size_t alignment, std::size_t size);
int __real_posix_memalign(void** pointer, std::size_t alignment, std::size_t size);
void __real_free(void* pointer);

void* __wrap_malloc(std::size_t size);
void* __wrap_calloc(std::size_t number, std::size_t size);
void* __wrap_realloc(void* pointer, std::size_t size);
void* __wrap_aligned_alloc(std::size_t alignment, std::size_t size);
int __wrap_posix_memalign(void** pointer, std::size_t alignment, std::size_t size);
void __wrap_free(void* pointer);

void* __wrap_malloc(std::size_t size) {
  count(g_allocations);
  return __real_malloc(size);
}

void* __wrap_calloc(std::size_t number, std::size_t size) {
  count(g_allocations);
  return __real_calloc(number, size);
}

void* __wrap_realloc(void* pointer, std::size_t size) {
  count(g_allocations);
  return __real_realloc(pointer, size);
}

void* __wrap_aligned_alloc(std::size_t alignment, std::size_t size) {
  count(g_allocations);
  return __real_aligned_alloc(alignment, size);
}

int __wrap_posix_memalign(void** pointer, std::size_t alignment, std::size_t size) {
  count(g_allocations);
  return __real_posix_memalign(pointer, alignment, size);
}

void __wrap_free(void* pointer) {
  count_release(pointer);
  __real_free(pointer);
}

}  // extern "C"

namespace {

void* allocate(std::size_t size) noexcept {
  count(g_allocations);
  return __real_malloc(size > 0 ? size : 1);
}

void* allocate(std::size_t size, std::align_val_t alignment) noexcept {
  count(g_allocations);
  void* pointer = nullptr;
  const int status =
      __real_posix_memalign(&pointer, static_cast<std::size_t>(alignment), size > 0 ? size : 1);
  return status == 0 ? pointer : nullptr;
}

void* checked(void* pointer) {
  if (pointer == nullptr) {
    throw std::bad_alloc();
  }
  return pointer;
}

void release(void* pointer) noexcept {
  count_release(pointer);
  __real_free(pointer);
}

}  // namespace

// Every form, as a sanitizer's library has its own of each and they do not call one another.

void* operator new(std::size_t size) { return checked(allocate(size)); }
void* operator new[](std::size_t size) { return checked(allocate(size)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return checked(allocate(size, alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return checked(allocate(size, alignment));
}
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return allocate(size);
}
void* operator new[](std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return allocate(size);
}
void* operator new(std::size_t size, std::align_val_t alignment,
                   const std::nothrow_t& /*tag*/) noexcept {
  return allocate(size, alignment);
}
void* operator new[](std::size_t size, std::align_val_t alignment,
                     const std::nothrow_t& /*tag*/) noexcept {
  return allocate(size, alignment);
}

void operator delete(void* pointer) noexcept { release(pointer); }
void operator delete[](void* pointer) noexcept { release(pointer); }
void operator delete(void* pointer, std::size_t /*size*/) noexcept { release(pointer); }
void operator delete[](void* pointer, std::size_t /*size*/) noexcept { release(pointer); }
void operator delete(void* pointer, std::align_val_t /*alignment*/) noexcept { release(pointer); }
void operator delete[](void* pointer, std::align_val_t /*alignment*/) noexcept { release(pointer); }
void operator delete(void* pointer, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
  release(pointer);
}
void operator delete[](void* pointer, std::size_t /*size*/,
                       std::align_val_t /*alignment*/) noexcept {
  release(pointer);
}
void operator delete(void* pointer, const std::nothrow_t& /*tag*/) noexcept { release(pointer); }
void operator delete[](void* pointer, const std::nothrow_t& /*tag*/) noexcept { release(pointer); }
void operator delete(void* pointer, std::align_val_t /*alignment*/,
                     const std::nothrow_t& /*tag*/) noexcept {
  release(pointer);
}
void operator delete[](void* pointer, std::align_val_t /*alignment*/,
                       const std::nothrow_t& /*tag*/) noexcept {
  release(pointer);
}

namespace tubesight::tests {

HeapGuard::HeapGuard(HeapScope scope) {
  if (g_armed.load() != Armed::kNot) {
    std::abort();
  }
  g_allocations = 0;
  g_releases = 0;
  t_watched = true;
  g_armed = scope == HeapScope::kAllThreads ? Armed::kAllThreads : Armed::kOneThread;
}

HeapGuard::~HeapGuard() {
  g_armed = Armed::kNot;
  t_watched = false;
}

HeapCalls HeapGuard::calls() const { return {g_allocations.load(), g_releases.load()}; }

}  // namespace tubesight::tests
