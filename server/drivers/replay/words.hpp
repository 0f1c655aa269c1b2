/// \file
/// The words of one line of a text log, read one after the other.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "common/core/angle.hpp"
#include "common/core/number_in.hpp"
#include "common/core/pose2.hpp"

namespace seeker::drivers {

/// The words between separators. The first failure is kept, so that a parser checks once at its end.
class Words {
 public:
  static constexpr std::string_view kBlank = " \t\r\n";
  static constexpr std::string_view kCommaOrBlank = ", \t\r\n";

  explicit Words(std::string_view text, std::string_view separators = kBlank) : rest_(text), separators_(separators) {}

  /// The next word; empty at the end of the line.
  std::string_view word() {
    const std::size_t first = rest_.find_first_not_of(separators_);
    if (first == std::string_view::npos) {
      rest_ = {};
      return {};
    }
    const std::size_t last = std::min(rest_.find_first_of(separators_, first), rest_.size());
    const std::string_view found = rest_.substr(first, last - first);
    rest_.remove_prefix(last);
    return found;
  }
  /// The next word as a number; 0 and good() == false where it is no number or not finite.
  double number() {
    const double value = any_number();
    if (!std::isfinite(value)) {
      good_ = false;
      return 0.0;
    }
    return value;
  }
  /// A reading of a scanner. "inf" is valid and means no return; "nan" and "-inf" give no information and become 0.
  double range() {
    const double value = any_number();
    return std::isnan(value) || value < 0.0 ? 0.0 : value;
  }
  Pose2 pose() {
    const double x = number();
    const double y = number();
    const double theta = number();
    return {x, y, wrap_angle(theta)};
  }
  void skip(int count) {
    for (int k = 0; k < count; ++k) {
      number();
    }
  }
  void fail() { good_ = false; }
  [[nodiscard]] bool good() const { return good_; }
  [[nodiscard]] bool at_end() const { return rest_.find_first_not_of(separators_) == std::string_view::npos; }

 private:
  /// The next word as a number, or as "inf" or "nan"; 0 and good() == false where it is none of these.
  double any_number() {
    const std::optional<double> value = number_in<double>(word());
    good_ = good_ && value;
    return value.value_or(0.0);
  }

  std::string_view rest_;
  std::string_view separators_;
  bool good_ = true;
};

}  // namespace seeker::drivers
