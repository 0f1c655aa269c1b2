/// \file
/// The poses of a survey made to agree with each other: what several sightings show pulls them together.
#pragma once

#include <span>
#include <vector>

#include "server/localize/survey.hpp"

namespace seeker::localize {

/// Residuals are those of points seen in two sightings or more, from the mean place of their observations.
struct AdjustmentReport {
  int points = 0;
  int observations = 0;
  double rms_before_m = 0.0;
  double rms_after_m = 0.0;
  double offset_px = 0.0;  ///< that all disparities had too much
};

/// A feature that shows a landmark whose place is known already.
struct KnownSight {
  std::size_t sighting = 0;
  std::size_t feature = 0;
  const Landmark* landmark = nullptr;
};

/// How the eye moved between two sightings.
struct SightingsApart {
  std::size_t from = 0;
  std::size_t to = 0;
  UncertainPose from_T_to;
};

/// Least squares over the planar poses of all sightings and the points that more than one of them shows, the points
/// eliminated (Triggs et al., Bundle Adjustment, 2000, section 6.1); the poses as they came, with their covariances,
/// hold the survey where it is. Errors of a tripod's or of SLAM's poses are shared by all features of a sighting:
/// without this they go into the landmarks. Poses, their covariances and disparities are replaced; a sighting that
/// shares nothing with others keeps its own pose. Landmarks of `known` hold it as well, each as firmly as its
/// covariance says, and err alike wherever they are seen. A sighting that one of `apart` leads to is held by that, not
/// by its own pose and covariance, which a filter told from the same motion and landmarks. Nothing is done with
/// params.adjustment.on == false. Asserts valid parameters. kInvalidArgument: as SurveyBuilder::add(); nothing is
/// changed then.
[[nodiscard]] Result<AdjustmentReport> adjust_poses(const StereoGeometry& geometry, const DatabaseParams& params,
                                                    std::vector<Sighting>& sightings,
                                                    std::span<const KnownSight> known = {},
                                                    std::span<const SightingsApart> apart = {});

}  // namespace seeker::localize
