/// \file
/// Extractor is the interface of every line extractor: a scan in, its lines out.
#pragma once

#include "server/lines/line.hpp"

namespace seeker::lines {

/// Finds the straight lines of a scan. The result depends on the scan alone; an extractor may keep buffers, so that
/// each thread needs its own.
class Extractor {
 public:
  Extractor() = default;
  Extractor(const Extractor&) = delete;
  Extractor& operator=(const Extractor&) = delete;
  virtual ~Extractor() = default;

  /// Extracts the lines of a scan that has passed validate(). `found` is overwritten; its memory is reused.
  virtual void extract(const LaserScan& scan, ScanLines& found) = 0;
  [[nodiscard]] ScanLines extract(const LaserScan& scan) {
    ScanLines found;
    extract(scan, found);
    return found;
  }
};

}  // namespace seeker::lines
