/// \file
/// A hash that identifies texts: of settings, of logs.
#pragma once

#include <string>
#include <string_view>

#include "common/core/hash.hpp"

namespace seeker::lab {

/// FNV-1a, 64 bits, as 16 hexadecimal digits. It identifies a text but gives no protection against manipulation.
class TextHash {
 public:
  void add(std::string_view text);
  [[nodiscard]] std::string hex() const;

 private:
  Fnv1a hash_;
};

}  // namespace seeker::lab
