#include "server/app/daemon/heap.hpp"

#include <malloc.h>

namespace seeker::app {
namespace {

constexpr int kLargeBlock_bytes = 128 * 1024;
constexpr int kHeaps = 2;

}  // namespace

void keep_heap_compact() {
  // A setting that the allocator refuses stays as it was: that costs memory, nothing else.
  static_cast<void>(mallopt(M_MMAP_THRESHOLD, kLargeBlock_bytes));  // also ends its growth by itself
  static_cast<void>(mallopt(M_TRIM_THRESHOLD, kLargeBlock_bytes));
  static_cast<void>(mallopt(M_ARENA_MAX, kHeaps));
}

}  // namespace seeker::app
