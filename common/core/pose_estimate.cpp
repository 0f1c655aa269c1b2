#include "common/core/pose_estimate.hpp"

namespace seeker {

std::string_view to_string(LocalisationQuality quality) {
  switch (quality) {
    case LocalisationQuality::kUnknown: return "UNKNOWN";
    case LocalisationQuality::kLocalised: return "LOCALISED";
    case LocalisationQuality::kDegraded: return "DEGRADED";
    case LocalisationQuality::kLost: return "LOST";
  }
  return "UNKNOWN";
}

}  // namespace seeker
