#include "server/localize/landmark_map.hpp"

#include <utility>

#include "common/core/assert.hpp"

namespace seeker::localize {

LandmarkMap::LandmarkMap(std::shared_ptr<const LandmarkDatabase> database_in, double sigma_floor_m)
    : database(std::move(database_in)), table(*database) {
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
    const auto eye = triangulate(geometry, features[i], params.noise);
    const double range_m = eye ? eye->p.head<2>().norm() : 0.0;
    if (eye && range_m >= params.range.min_m && range_m <= params.range.max_m) {
      lifted.push_back({i, *eye, measure(*eye, features[i].disparity_px, params.measurement)});
    }
  }
  return lifted;
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
