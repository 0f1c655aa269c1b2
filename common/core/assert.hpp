/// \file
/// Checks for bugs of the program, active in every build. Input from outside is checked with Result instead.
#pragma once

namespace seeker {

/// Prints the failed condition with its file and line, and aborts.
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);

}  // namespace seeker

/// Aborts when `condition` is false: the program is wrong, not its input.
#define SEEKER_ASSERT(condition)                                  \
  do {                                                            \
    if (!(condition)) {                                           \
      ::seeker::assertion_failed(#condition, __FILE__, __LINE__); \
    }                                                             \
  } while (false)
