#include "common/config/number_text.hpp"

#include <optional>

#include "common/core/number_in.hpp"

namespace seeker::config {
namespace {

/// People write a sign before a distance to the left or right, be it + or -.
std::optional<double> number(std::string_view text) { return finite_in(text.starts_with('+') ? text.substr(1) : text); }

std::string unless(bool good, const std::string& wanted, const std::string& text) {
  return good ? "" : "must be " + wanted + ", not '" + text + "'";
}

}  // namespace

std::string finite_number(const std::string& text) { return unless(number(text).has_value(), "a number", text); }

std::string number_above_zero(const std::string& text) {
  return unless(number(text).value_or(0.0) > 0.0, "a number above 0", text);
}

std::string number_from_zero(const std::string& text) {
  return unless(number(text).value_or(-1.0) >= 0.0, "a number, 0 or above", text);
}

}  // namespace seeker::config
