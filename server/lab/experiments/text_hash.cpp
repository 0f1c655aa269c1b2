#include "server/lab/experiments/text_hash.hpp"

#include <array>
#include <cstdio>

namespace seeker::lab {

void TextHash::add(std::string_view text) {
  hash_.add(text);
  hash_.add_byte(0xffU);  // ends the text: "ab", "c" differs from "a", "bc"
}

std::string TextHash::hex() const {
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash_.value()));
  return digits.data();
}

}  // namespace seeker::lab
