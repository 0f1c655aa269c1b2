/// \file
/// Pass conditions as lines that people and scripts read: "PASS R5 bearing_deg=3.2 limit=5 seeds=1-20".
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
};

[[nodiscard]] std::string line_of(const Check& check);

/// Collects checks and prints each one when it is added.
class Report {
 public:
  explicit Report(std::ostream* out) : out_(out) {}
  void add(Check check);
  [[nodiscard]] const std::vector<Check>& checks() const { return checks_; }
  [[nodiscard]] bool passed() const;
  [[nodiscard]] std::string json() const;

 private:
  std::ostream* out_;  ///< null: quiet
  std::vector<Check> checks_;
};

}  // namespace seeker::lab
