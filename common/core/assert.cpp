#include "common/core/assert.hpp"

#include <cstdio>
#include <cstdlib>

namespace seeker {

void assertion_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: bug: assertion failed: %s\n", file, line, condition);
  std::abort();
}

}  // namespace seeker
