#include "common/core/natural_order.hpp"

#include <algorithm>
#include <cstddef>

namespace seeker {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The run of digits, or the one other character, that a text begins with.
std::string_view first_token(std::string_view text) {
  std::size_t end = 1;
  while (is_digit(text.front()) && end < text.size() && is_digit(text[end])) {
    ++end;
  }
  return text.substr(0, end);
}

std::string_view without_zeros(std::string_view digits) {
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size() - 1));
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
  std::string_view left = a;
  std::string_view right = b;
  while (!left.empty() && !right.empty()) {
    std::string_view x = first_token(left);
    std::string_view y = first_token(right);
    left.remove_prefix(x.size());
    right.remove_prefix(y.size());
    if (is_digit(x.front()) && is_digit(y.front())) {
      x = without_zeros(x);
      y = without_zeros(y);
      if (x.size() != y.size()) {
        return x.size() < y.size();
      }
    }
    if (x != y) {
      return x < y;
    }
  }
  return left.size() != right.size() ? left.size() < right.size() : a < b;
}

}  // namespace seeker
