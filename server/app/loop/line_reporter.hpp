/// \file
/// LineReporter extracts the lines of a scan for the clients that follow them.
#pragma once

#include <memory>

#include "common/api/scan_lines.hpp"
#include "server/lines/make_extractor.hpp"

namespace seeker::app {

/// Owns an extractor of its own, so that the estimator's is not disturbed. Lives on the loop's thread.
class LineReporter {
 public:
  explicit LineReporter(const lines::ExtractorParams& params);

  /// The lines of a scan that has passed validate().
  [[nodiscard]] api::LineReport report(const LaserScan& scan);

 private:
  lines::ExtractorKind kind_;
  std::unique_ptr<lines::Extractor> extractor_;
  lines::ScanLines found_;
};

}  // namespace seeker::app
