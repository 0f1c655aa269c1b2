/// \file
/// Building a database from sightings whose poses are known (spec S2.4-S2.7).
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "common/core/result.hpp"
#include "server/localize/association.hpp"

namespace seeker::localize {

/// How the poses of a survey are made to agree with each other before the database is built (adjust_poses()).
struct AdjustmentParams {
  bool on = true;
  int rounds = 2;                ///< of telling anew what is the same point
  int iterations = 4;            ///< of the least squares in each
  double huber_sigmas = 2.0;     ///< observations farther off weigh less
  double point_sigma_m = 0.003;  ///< of every observation, beside its pixels: blobs differ from side to side
  double offset_sigma_px = 0.2;  ///< of the error that all disparities share

  friend bool operator==(const AdjustmentParams&, const AdjustmentParams&) = default;
};

struct DatabaseParams {
  PixelNoise noise;
  RangeLimits range;
  AssociationParams association;
  SparsityParams sparsity;
  FusionParams fusion;
  AdjustmentParams adjustment;
  /// Spec S2.7: landmarks seen less often are dropped at the end; 1 keeps all. With 2 the localiser errs by half as
  /// much (5 mm instead of 10 in `reproduce s2`), and takes 2 of 100 views of rooms never surveyed for places.
  int salient_seen = 3;

  friend bool operator==(const DatabaseParams&, const DatabaseParams&) = default;
};

/// The gates of the paper: L1, 2.5, whole database, running mean, first descriptor.
[[nodiscard]] DatabaseParams paper_database_params();
/// kInvalidArgument with the field's name.
[[nodiscard]] Status validate(const DatabaseParams& params);

/// What became of the features of one sighting (spec S2.11, Table 2 and Fig 7).
struct SightingCounts {
  int features = 0;
  int in_range = 0;
  int matched = 0;     ///< taken for a landmark that was there
  int sparsified = 0;  ///< refused by the sparsity rule; none where that is applied at the end
  int inserted = 0;    ///< new landmarks

  friend bool operator==(const SightingCounts&, const SightingCounts&) = default;
};

/// What became of one feature.
enum class FeatureFate : std::uint8_t { kOutOfRange, kMatched, kSparsified, kInserted };
[[nodiscard]] std::string_view to_string(FeatureFate fate);

/// Grows a database by one sighting after another, in the order in which they were taken.
class SurveyBuilder {
 public:
  /// Asserts that both arguments are valid.
  SurveyBuilder(const StereoGeometry& geometry, const DatabaseParams& params);

  /// kInvalidArgument: a pose that is not finite or out of range, a covariance that is none. Nothing is changed then.
  [[nodiscard]] Result<SightingCounts> add(const Sighting& sighting);
  /// Of each feature of the newest sighting.
  [[nodiscard]] const std::vector<FeatureFate>& fates() const { return fates_; }
  /// Which landmark each feature of the newest sighting was taken for, or has become; 0: none.
  [[nodiscard]] const std::vector<LandmarkId>& landmarks() const { return landmarks_; }
  /// All so far, salient or not, and not thinned out yet where SparsityParams::best_first does that at the end.
  [[nodiscard]] const LandmarkDatabase& database() const { return database_; }
  /// Spec S2.7: those that were seen often enough, and of these what the sparsity rule leaves.
  [[nodiscard]] LandmarkDatabase salient() const;
  /// Begins anew; ids go on rising.
  void clear();

 private:
  StereoGeometry geometry_;
  DatabaseParams params_;
  LandmarkDatabase database_;
  std::vector<FeatureFate> fates_;
  std::vector<LandmarkId> landmarks_;
};

/// kInvalidArgument for a sighting whose pose cannot be one.
[[nodiscard]] Status check_pose(const Sighting& sighting);

}  // namespace seeker::localize
