/// \file
/// Checks for bugs of our own, active in every build. Never used for what comes from outside (use Result).
#pragma once

namespace seeker {

/// Prints the failed condition with its place and aborts.
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);

}  // namespace seeker

/// Aborts when `condition` is false: the program is wrong, not its input.
#define SEEKER_ASSERT(condition)                                  \
  do {                                                            \
    if (!(condition)) {                                           \
      ::seeker::assertion_failed(#condition, __FILE__, __LINE__); \
    }                                                             \
  } while (false)
