#include "allocation_count.h"

#include <atomic>
#include <cstdlib>
#include <new>

static std::atomic<long> allocations{0};

void* operator new(size_t size) {
  ++allocations;
  if (void* block = std::malloc(size > 0 ? size : 1)) return block;
  throw std::bad_alloc();
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, size_t) noexcept { std::free(block); }

namespace monocular_eye_hand {

long allocationCount() { return allocations; }

}  // namespace monocular_eye_hand
