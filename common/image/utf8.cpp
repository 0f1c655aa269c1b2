#include "common/image/utf8.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace seeker::image {

std::string valid_utf8(std::string_view text) {
  constexpr std::array<std::uint32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};  // by length; less is an overlong form
  std::string valid;
  for (std::size_t at = 0; at < text.size();) {
    const auto lead = static_cast<std::uint8_t>(text[at]);
    const std::size_t length = lead < 0x80   ? 1
                               : lead < 0xC0 ? 0
                               : lead < 0xE0 ? 2
                               : lead < 0xF0 ? 3
                               : lead < 0xF8 ? 4
                                             : 0;
    std::uint32_t code = length < 2 ? lead : lead & (0x7FU >> length);
    std::size_t taken = std::min<std::size_t>(1, length);
    for (; taken < length && at + taken < text.size() && (static_cast<std::uint8_t>(text[at + taken]) & 0xC0U) == 0x80U;
         ++taken) {
      code = code << 6U | (static_cast<std::uint8_t>(text[at + taken]) & 0x3FU);
    }
    const bool surrogate = code >= 0xD800 && code < 0xE000;
    if (length > 0 && taken == length && code >= std::max(kLeast[length], 1U) && !surrogate && code < 0x110000) {
      valid += text.substr(at, length);
    }
    at += std::max<std::size_t>(1, taken);
  }
  return valid;
}

}  // namespace seeker::image
