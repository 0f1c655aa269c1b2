#include "common/api/fleet.hpp"

namespace seeker::api {

std::string_view to_string(FleetState state) {
  switch (state) {
    case FleetState::kWaiting: return "WAITING";
    case FleetState::kMerged: return "MERGED";
    case FleetState::kAmbiguous: return "AMBIGUOUS";
    case FleetState::kInsufficientOverlap: return "INSUFFICIENT_OVERLAP";
    case FleetState::kContradicted: return "CONTRADICTED";
    case FleetState::kSplit: return "SPLIT";
  }
  return "WAITING";
}

}  // namespace seeker::api
