/// \file
/// Pass conditions as lines that people and scripts read: "PASS R5 bearing_deg=3.2 limit=5 seeds=1-20".
///
/// A condition that the method as printed in its paper does not meet, while ours does, is a FINDING: it is reported
/// with its cause in docs/printed.md instead of being adjusted away, and it fails no report.
#pragma once

#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace seeker::lab {

/// One condition and the figures that it is based on.
struct Check {
  std::string id;  ///< number in spec S7, e.g. "R5"
  bool passed = false;
  std::vector<std::pair<std::string, std::string>> figures;  ///< name and value, neither with spaces
  /// True: not met by the method as printed only, or by an experiment that leaves nothing to show; a FINDING where it
  /// has not passed.
  bool finding = false;
};

/// PASS, FAIL or FINDING.
[[nodiscard]] std::string verdict_of(const Check& check);

[[nodiscard]] std::string line_of(const Check& check);

/// Collects checks and prints each one when it is added.
class Report {
 public:
  explicit Report(std::ostream* out) : out_(out) {}
  void add(Check check);
  [[nodiscard]] const std::vector<Check>& checks() const { return checks_; }
  /// Whether no check is a FAIL.
  [[nodiscard]] bool passed() const;
  [[nodiscard]] std::string json() const;

 private:
  std::ostream* out_;  ///< null: quiet
  std::vector<Check> checks_;
};

}  // namespace seeker::lab
