// seeker-lab: offline experiments. All code is in libraries.

#include <malloc.h>

#include "server/lab/command/commands.hpp"

int main(int argc, char** argv) {
  // Otherwise the memory of each picture goes back to the system, which clears it page by page for the next one: a
  // third of the time of all that looks at pictures.
  constexpr int kLargestKept_bytes = 32 << 20;
  constexpr int kKept_bytes = 512 << 20;
  mallopt(M_MMAP_THRESHOLD, kLargestKept_bytes);
  mallopt(M_TRIM_THRESHOLD, kKept_bytes);
  return seeker::lab::run_lab(argc, argv);
}
