/// \file
/// A database prepared for localisation: read only, shared, with precomputed data for the frames.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "server/localize/localiser_params.hpp"

namespace seeker::localize {

struct LandmarkMap {
  std::shared_ptr<const LandmarkDatabase> database;
  DescriptorTable table;
  std::vector<Matrix3> covariances;  ///< covariance of each landmark's position

  /// `sigma_floor_m` is the lower limit of the standard deviation of a landmark in any direction. The table is searched
  /// by best-bin-first search where `bbf_leaves` is above 0.
  LandmarkMap(std::shared_ptr<const LandmarkDatabase> database, double sigma_floor_m, int bbf_leaves = 0,
              vision::Metric metric = vision::Metric::kL2);
  /// Prepares a database for a localiser with these parameters.
  LandmarkMap(std::shared_ptr<const LandmarkDatabase> landmarks, const LocaliserParams& params)
      : LandmarkMap(std::move(landmarks), params.landmark_sigma_floor_m, params.bbf_leaves, params.metric) {}
  [[nodiscard]] const Landmark& at(std::size_t index) const { return database->at(index); }
};

/// A feature of the present frame in the frame `eye`.
struct EyeFeature {
  std::size_t feature = 0;  ///< its index in the frame
  UncertainPoint eye;
  RangeBearing seen;     ///< measurement without a landmark yet
  double scale_m = 0.0;  ///< sigma of its blur at its distance
};

/// Triangulates features; those outside the range limits are left out.
[[nodiscard]] std::vector<EyeFeature> lift(const StereoGeometry& geometry,
                                           std::span<const vision::StereoFeature> features,
                                           const LocaliserParams& params);

/// Whether feature and landmark have the same height, as far as both are known and within `tolerance_m`.
[[nodiscard]] bool heights_agree(const EyeFeature& feature, const LandmarkMap& map, std::size_t landmark,
                                 double tolerance_m, const LocaliserParams& params);

/// Whether feature and landmark have the same scale, each at most `ratio` times as large as the other.
[[nodiscard]] bool scales_agree(const EyeFeature& feature, const Landmark& landmark, double ratio);

/// The measurement of a feature associated with a landmark, whose covariance is counted `repeats` times.
[[nodiscard]] RangeBearing with_landmark(const EyeFeature& feature, const LandmarkMap& map, std::size_t landmark,
                                         double repeats, const LocaliserParams& params);

}  // namespace seeker::localize
