#include "common/config/fields.hpp"

#include <algorithm>

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

void Fields::angles_deg(std::string_view key, std::vector<double>& values_rad) {
  std::vector<double> values_deg(values_rad.size());
  std::transform(values_rad.begin(), values_rad.end(), values_deg.begin(), [](double v) { return rad_to_deg(v); });
  const std::vector<double> before = values_deg;
  field(key, values_deg);
  if (values_deg != before) {
    values_rad.resize(values_deg.size());
    std::transform(values_deg.begin(), values_deg.end(), values_rad.begin(), [](double v) { return deg_to_rad(v); });
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
