#include "server/protocols/lms200/baud_rate.hpp"

#include <array>

#include "common/core/assert.hpp"

namespace seeker::lms200 {
namespace {

constexpr std::array<std::uint32_t, 4> kRates{9600, 19200, 38400, 500000};
constexpr std::array<std::uint8_t, 4> kModes{0x42, 0x41, 0x40, 0x48};

}  // namespace

std::span<const std::uint32_t> baud_rates() { return kRates; }

std::optional<std::uint8_t> baud_mode(std::uint32_t baud) {
  for (std::size_t i = 0; i < kRates.size(); ++i) {
    if (kRates.at(i) == baud) {
      return kModes.at(i);
    }
  }
  return std::nullopt;
}

std::optional<std::uint32_t> baud_of_mode(std::uint8_t mode) {
  for (std::size_t i = 0; i < kModes.size(); ++i) {
    if (kModes.at(i) == mode) {
      return kRates.at(i);
    }
  }
  return std::nullopt;
}

std::uint16_t baud_word(std::uint32_t baud) {
  SEEKER_ASSERT(baud_mode(baud).has_value());
  constexpr std::uint32_t kClock_hz = 1'000'000;
  constexpr std::uint32_t kSet = 0x8000;
  return static_cast<std::uint16_t>(kSet | (kClock_hz / baud - 1));
}

}  // namespace seeker::lms200
