/// \file
/// The figures of a robot, read as Prometheus reads them.
#pragma once

#include <map>
#include <regex>
#include <sstream>
#include <string>

#include "tests/integration/processes/daemon.hpp"

namespace seeker::testing {

inline constexpr const char* kCurl = "/usr/bin/curl";

/// Where the log says that the page is.
inline std::string page_of(const Daemon& daemon) {
  std::smatch found;
  const std::string log = daemon.process->output();
  EXPECT_TRUE(std::regex_search(log, found, std::regex("metrics at (http://\\S+)"))) << log;
  return found.empty() ? "" : found[1].str();
}

inline std::string read_page(const std::string& address) {
  ChildProcess curl(kCurl, {"--silent", "--show-error", "--fail", address}, fresh_folder("curl") / "page");
  EXPECT_EQ(curl.wait(kCall), 0) << curl.output();
  return curl.output();
}

/// The periods of the control loop as the page tells them: how many lie below each bound.
class LoopPeriods {
 public:
  explicit LoopPeriods(const std::string& page) {
    const std::regex bucket("seeker_loop_period_seconds_bucket\\{le=\"([0-9.]+|\\+Inf)\"\\} ([0-9]+)");
    for (std::sregex_iterator found(page.begin(), page.end(), bucket), end; found != end; ++found) {
      below_[std::stod((*found)[1])] = std::stod((*found)[2]);
    }
  }
  /// Those since an earlier page.
  [[nodiscard]] LoopPeriods since(const LoopPeriods& earlier) const {
    LoopPeriods out = *this;
    for (auto& [bound, count] : out.below_) {
      count -= earlier.below_.at(bound);
    }
    return out;
  }
  [[nodiscard]] double count() const { return below_.empty() ? 0.0 : below_.rbegin()->second; }
  /// In seconds, by interpolation between two bounds.
  [[nodiscard]] double quantile_s(double share) const {
    const double wanted = share * count();
    double bound_before = 0.0;
    double count_before = 0.0;
    for (const auto& [bound, count] : below_) {
      if (count >= wanted) {
        const double part = count > count_before ? (wanted - count_before) / (count - count_before) : 1.0;
        return bound_before + part * (bound - bound_before);
      }
      bound_before = bound;
      count_before = count;
    }
    return bound_before;
  }

 private:
  std::map<double, double> below_;  ///< by bound in seconds
};

}  // namespace seeker::testing
