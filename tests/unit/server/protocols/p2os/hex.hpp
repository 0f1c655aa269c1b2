/// \file
/// Bytes as the manuals print them.
#pragma once

#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace seeker::p2os {

inline std::vector<std::uint8_t> hex(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::uint8_t> bytes;
  for (std::string byte; in >> byte;) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(byte, nullptr, 16)));
  }
  return bytes;
}

}  // namespace seeker::p2os
