#include "server/vision/sighting.hpp"

namespace seeker::vision {

std::string_view to_string(TargetKind kind) {
  switch (kind) {
    case TargetKind::kTemplate: return "template";
    case TargetKind::kFeature: return "feature";
    case TargetKind::kSolid: return "solid";
  }
  return "unknown";
}

StageCounts& StageCounts::operator+=(const StageCounts& other) {
  regions += other.regions;
  rejected_area += other.rejected_area;
  rejected_duplicate += other.rejected_duplicate;
  rejected_aspect += other.rejected_aspect;
  candidates += other.candidates;
  rejected_ncc += other.rejected_ncc;
  rejected_verify += other.rejected_verify;
  rejected_overlap += other.rejected_overlap;
  features += other.features;
  matches += other.matches;
  rejected_geometry += other.rejected_geometry;
  accepted += other.accepted;
  return *this;
}

}  // namespace seeker::vision
