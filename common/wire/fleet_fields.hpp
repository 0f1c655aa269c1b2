/// \file
/// Fields that several messages of a fleet have.
#pragma once

#include <string>

#include "common/wire/check.hpp"

namespace seeker::wire {

/// 1 to 32 characters of a-z, 0-9 and -.
[[nodiscard]] std::string read_robot_id(const std::string& id, Check& check);

}  // namespace seeker::wire
