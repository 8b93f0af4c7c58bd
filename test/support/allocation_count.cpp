#include "support/allocation_count.h"

#include <atomic>
#include <cstdlib>
#include <new>

static std::atomic<long> allocations{0};

static void* counted(size_t size, size_t alignment = alignof(std::max_align_t)) {
  ++allocations;
  const size_t whole = (size + alignment - 1) / alignment * alignment;  // aligned_alloc wants a multiple
  if (void* block = std::aligned_alloc(alignment, whole > 0 ? whole : alignment)) return block;
  throw std::bad_alloc();
}

// The forms for arrays and those that do not throw call these.
void* operator new(size_t size) { return counted(size); }
void* operator new(size_t size, std::align_val_t alignment) { return counted(size, size_t(alignment)); }
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, size_t) noexcept { std::free(block); }
void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, size_t, std::align_val_t) noexcept { std::free(block); }

namespace monocular_eye_hand {

long allocationCount() { return allocations; }

}  // namespace monocular_eye_hand
