/// \file
/// A database made ready for localising: read only, shared, with what each frame asks of it worked out once.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "server/localize/localiser_params.hpp"

namespace seeker::localize {

struct LandmarkMap {
  std::shared_ptr<const LandmarkDatabase> database;
  DescriptorTable table;
  std::vector<Matrix3> covariances;  ///< of each landmark's place

  /// `sigma_floor_m`: no landmark is more certain than this in any direction.
  LandmarkMap(std::shared_ptr<const LandmarkDatabase> database, double sigma_floor_m);
  [[nodiscard]] const Landmark& at(std::size_t index) const { return database->at(index); }
};

/// A feature of the frame at hand, seen from the eye.
struct EyeFeature {
  std::size_t feature = 0;  ///< its index in the frame
  UncertainPoint eye;
  RangeBearing seen;     ///< without a landmark yet
  double scale_m = 0.0;  ///< sigma of its blur at its distance
};

/// Features outside the range limits are left out.
[[nodiscard]] std::vector<EyeFeature> lift(const StereoGeometry& geometry,
                                           std::span<const vision::StereoFeature> features,
                                           const LocaliserParams& params);

/// Whether feature and landmark stand at the same height, as far as both are known and within `tolerance_m`.
[[nodiscard]] bool heights_agree(const EyeFeature& feature, const LandmarkMap& map, std::size_t landmark,
                                 double tolerance_m, const LocaliserParams& params);

/// Whether feature and landmark are of one scale, each at most `ratio` times as large as the other.
[[nodiscard]] bool scales_agree(const EyeFeature& feature, const Landmark& landmark, double ratio);

/// The measurement of a feature taken for a landmark, whose covariance is counted `repeats` times.
[[nodiscard]] RangeBearing with_landmark(const EyeFeature& feature, const LandmarkMap& map, std::size_t landmark,
                                         double repeats, const LocaliserParams& params);

}  // namespace seeker::localize
