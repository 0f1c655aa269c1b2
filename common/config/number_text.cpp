#include "common/config/number_text.hpp"

#include <cmath>
#include <cstdlib>
#include <optional>

namespace seeker::config {
namespace {

std::optional<double> finite_in(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::string unless(bool good, const std::string& wanted, const std::string& text) {
  return good ? "" : "must be " + wanted + ", not '" + text + "'";
}

}  // namespace

std::string finite_number(const std::string& text) { return unless(finite_in(text).has_value(), "a number", text); }

std::string number_above_zero(const std::string& text) {
  return unless(finite_in(text).value_or(0.0) > 0.0, "a number above 0", text);
}

std::string number_from_zero(const std::string& text) {
  return unless(finite_in(text).value_or(-1.0) >= 0.0, "a number, 0 or above", text);
}

}  // namespace seeker::config
