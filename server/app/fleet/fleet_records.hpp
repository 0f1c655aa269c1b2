/// \file
/// What the main robot of a fleet found out about two maps, as it is kept on its disk.
#pragma once

#include <string>

#include "seeker/v1/kept.pb.h"
#include "server/fleet/map_merger.hpp"

namespace seeker::app {

void write(const fleet::MergeAnswer& from, v1::KeptPair* to);
/// Trusts nothing: kInvalidArgument for what is no answer of ours. What was rejected on the way to it is not kept.
[[nodiscard]] Result<fleet::MergeAnswer> read_answer(const v1::KeptPair& from);

}  // namespace seeker::app
