/// \file
/// How a base introduces itself in its answer to SYNC2 (protocols 1.3).
#pragma once

#include <string>

#include "common/core/result.hpp"
#include "server/protocols/p2os/packet.hpp"

namespace seeker::p2os {

struct Identity {
  std::string name;        ///< as its owner called it
  std::string class_name;  ///< "Pioneer"
  std::string subclass;    ///< selects the model, see find_pioneer_model()

  friend bool operator==(const Identity&, const Identity&) = default;
};

/// Reads the answer to SYNC2. kCorrupt: it does not hold three texts.
[[nodiscard]] Result<Identity> read_identity(const Packet& packet);
/// The answer to SYNC2; the three texts and their ends are at most kMaxDataBytes.
[[nodiscard]] Packet write_identity(const Identity& identity);

}  // namespace seeker::p2os
