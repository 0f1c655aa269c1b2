#include "common/config/fields.hpp"

#include "common/core/angle.hpp"

namespace seeker::config {

void Fields::angle_deg(std::string_view key, double& value_rad) {
  double value_deg = rad_to_deg(value_rad);
  const double before = value_deg;
  field(key, value_deg);
  if (value_deg != before) {
    value_rad = deg_to_rad(value_deg);
  }
}

void Fields::seconds(std::string_view key, Duration& value) {
  double value_s = to_seconds(value);
  field(key, value_s);
  constexpr double kLongest_s = 1e9;
  check(key, value_s >= 0.0 && value_s <= kLongest_s, "must be from 0 to 1e9 seconds");
  if (value_s >= 0.0 && value_s <= kLongest_s) {
    value = seeker::seconds(value_s);
  }
}

}  // namespace seeker::config
