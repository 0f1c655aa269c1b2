/// \file
/// Building a database from sightings whose poses are known (spec S2.4-S2.7).
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "common/core/result.hpp"
#include "server/localize/association.hpp"

namespace seeker::localize {

/// Parameters of the adjustment of a survey's poses before the database is built (adjust_poses()).
struct AdjustmentParams {
  bool on = true;
  int rounds = 2;             ///< number of data associations
  int iterations = 4;         ///< iterations of least squares in each
  double huber_sigmas = 2.0;  ///< observations farther off have a smaller weight
  /// Error of every observation in addition to its pixels: features differ from side to side.
  double point_sigma_m = 0.003;
  double offset_sigma_px = 0.2;  ///< standard deviation of the common error of all disparities

  friend bool operator==(const AdjustmentParams&, const AdjustmentParams&) = default;
};

struct DatabaseParams {
  PixelNoise noise;
  RangeLimits range;
  AssociationParams association;
  SparsityParams sparsity;
  FusionParams fusion;
  AdjustmentParams adjustment;
  /// Spec S2.7: landmarks observed less often are dropped at the end; 1 keeps all. With 2 the error of the localiser is
  /// half as large (5 mm instead of 10 in `reproduce s2`), but 2 of 100 views of rooms never surveyed are localised.
  int salient_seen = 3;

  friend bool operator==(const DatabaseParams&, const DatabaseParams&) = default;
};

/// The parameters of the paper: L1, 2.5, whole database by best-bin-first search, running mean, first descriptor, and
/// poses as given.
[[nodiscard]] DatabaseParams paper_database_params();
/// Fails with kInvalidArgument and the field's name.
[[nodiscard]] Status validate(const DatabaseParams& params);

/// Counts of the features of one sighting (spec S2.11, Table 2 and Fig 7).
struct SightingCounts {
  int features = 0;
  int in_range = 0;
  int matched = 0;     ///< number associated with an existing landmark
  int sparsified = 0;  ///< number refused by the sparsity rule; none where it is applied at the end
  int inserted = 0;    ///< number of new landmarks

  friend bool operator==(const SightingCounts&, const SightingCounts&) = default;
};

/// Result of one feature.
enum class FeatureFate : std::uint8_t { kOutOfRange, kMatched, kSparsified, kInserted };
[[nodiscard]] std::string_view to_string(FeatureFate fate);

/// Builds a database from sightings in the order in which they were taken.
class SurveyBuilder {
 public:
  /// Requires valid arguments (asserted).
  SurveyBuilder(const StereoGeometry& geometry, const DatabaseParams& params);

  /// Adds a sighting. Fails with kInvalidArgument, without any change, for a pose that is not finite or out of range,
  /// or an invalid covariance.
  [[nodiscard]] Result<SightingCounts> add(const Sighting& sighting);
  /// Results of the features of the newest sighting.
  [[nodiscard]] const std::vector<FeatureFate>& fates() const { return fates_; }
  /// The landmark with which each feature of the newest sighting was associated, or which it became; 0: none.
  [[nodiscard]] const std::vector<LandmarkId>& landmarks() const { return landmarks_; }
  /// All landmarks so far, salient or not, and not thinned out yet where SparsityParams::best_first does that at the
  /// end.
  [[nodiscard]] const LandmarkDatabase& database() const { return database_; }
  /// Spec S2.7: the landmarks observed often enough, after the sparsity rule.
  [[nodiscard]] LandmarkDatabase salient() const;
  /// Restarts with an empty database; ids continue to rise.
  void clear();

 private:
  StereoGeometry geometry_;
  DatabaseParams params_;
  LandmarkDatabase database_;
  std::vector<FeatureFate> fates_;
  std::vector<LandmarkId> landmarks_;
};

/// Fails with kInvalidArgument for a sighting with an invalid pose.
[[nodiscard]] Status check_pose(const Sighting& sighting);

}  // namespace seeker::localize
