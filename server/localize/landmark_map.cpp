#include "server/localize/landmark_map.hpp"

#include <cmath>
#include <utility>

#include "common/core/assert.hpp"

namespace seeker::localize {

LandmarkMap::LandmarkMap(std::shared_ptr<const LandmarkDatabase> database_in, double sigma_floor_m, int bbf_leaves,
                         vision::Metric metric)
    : database(std::move(database_in)), table(*database, bbf_leaves, metric) {
  covariances.reserve(database->size());
  const Matrix3 floor = sigma_floor_m * sigma_floor_m * Matrix3::Identity();
  for (const Landmark& landmark : database->landmarks()) {
    covariances.push_back(landmark.covariance() + floor);
  }
}

std::vector<EyeFeature> lift(const StereoGeometry& geometry, std::span<const vision::StereoFeature> features,
                             const LocaliserParams& params) {
  std::vector<EyeFeature> lifted;
  lifted.reserve(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (const auto eye = triangulate_within(geometry, features[i], params.noise, params.range)) {
      lifted.push_back({i, *eye, measure(*eye, features[i].disparity_px, params.measurement),
                        scale_of(geometry, features[i], *eye)});
    }
  }
  return lifted;
}

bool heights_agree(const EyeFeature& feature, const LandmarkMap& map, std::size_t landmark, double tolerance_m,
                   const LocaliserParams& params) {
  const double difference_m = feature.eye.p.z() + params.eye_height_m - map.at(landmark).p_map.z();
  const double sigma_m = std::sqrt(feature.eye.covariance(2, 2) + map.covariances[landmark](2, 2));
  return std::abs(difference_m) <= tolerance_m + params.tracking.window_sigmas * sigma_m;
}

bool scales_agree(const EyeFeature& feature, const Landmark& landmark, double ratio) {
  return feature.scale_m <= ratio * landmark.scale_m && landmark.scale_m <= ratio * feature.scale_m;
}

RangeBearing with_landmark(const EyeFeature& feature, const LandmarkMap& map, std::size_t landmark, double repeats,
                           const LocaliserParams& params) {
  RangeBearing seen = feature.seen;
  seen.landmark = map.at(landmark).p_map.head<2>();
  if (params.measurement.landmark_covariance) {
    seen.landmark_covariance = repeats * map.covariances[landmark].topLeftCorner<2, 2>();
  }
  return seen;
}

}  // namespace seeker::localize
