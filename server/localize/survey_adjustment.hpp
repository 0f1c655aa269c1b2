/// \file
/// Adjustment of the poses of a survey by the points that several sightings share.
#pragma once

#include <span>
#include <vector>

#include "server/localize/survey.hpp"

namespace seeker::localize {

/// Residuals are those of points observed in two sightings or more, from the mean position of their observations.
struct AdjustmentReport {
  int points = 0;
  int observations = 0;
  double rms_before_m = 0.0;
  double rms_after_m = 0.0;
  double offset_px = 0.0;  ///< common error of all disparities
};

/// A feature associated with a landmark of known position.
struct KnownSight {
  std::size_t sighting = 0;
  std::size_t feature = 0;
  const Landmark* landmark = nullptr;
};

/// Motion of the eye between two sightings.
struct SightingsApart {
  std::size_t from = 0;
  std::size_t to = 0;
  UncertainPose from_T_to;
};

/// Least squares over the planar poses of all sightings and the points that more than one of them shows, the points
/// eliminated (Triggs et al., Bundle Adjustment, 2000, section 6.1). The given poses with their covariances fix the
/// survey. Errors of the poses of a tripod or of SLAM are common to all features of a sighting, and would enter the
/// landmarks without this adjustment. Poses, their covariances and disparities are replaced; a sighting that shares no
/// point with others keeps its own pose. Landmarks of `known` constrain the survey as well, each by its covariance,
/// with an error that is common to all its observations. A sighting that an entry of `apart` leads to is constrained by
/// that instead of its own pose and covariance, which a filter derived from the same motion and landmarks. No
/// adjustment is made with params.adjustment.on == false. Asserts valid parameters. Fails with kInvalidArgument as
/// SurveyBuilder::add(), without any change.
[[nodiscard]] Result<AdjustmentReport> adjust_poses(const StereoGeometry& geometry, const DatabaseParams& params,
                                                    std::vector<Sighting>& sightings,
                                                    std::span<const KnownSight> known = {},
                                                    std::span<const SightingsApart> apart = {});

}  // namespace seeker::localize
