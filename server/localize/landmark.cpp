#include "server/localize/landmark.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "common/core/angle.hpp"

namespace seeker::localize {
namespace {

/// Added to a covariance before it is inverted: a point straight ahead has none sideways worth speaking of.
constexpr double kTinyVariance_m2 = 1e-8;

Matrix3 inverse_of(const Matrix3& covariance) {
  const Matrix3 inverse = (covariance + kTinyVariance_m2 * Matrix3::Identity()).inverse();
  return 0.5 * (inverse + inverse.transpose());
}

/// Mean of two positions, by certainty or by counts, and the information of both.
void fuse_place(Landmark& landmark, const Point3& p_map, const Matrix3& information, int seen,
                const FusionParams& params) {
  const Matrix3 sum = landmark.information + information;
  if (params.running_mean) {
    const double share = static_cast<double>(seen) / static_cast<double>(landmark.seen + seen);
    landmark.p_map += share * (p_map - landmark.p_map);
  } else {
    landmark.p_map = sum.ldlt().solve(landmark.information * landmark.p_map + information * p_map);
  }
  landmark.information = 0.5 * (sum + sum.transpose());
}

void fuse_direction(Landmark& landmark, const Point3& to_eye, double concentration, int seen) {
  const auto before = static_cast<double>(landmark.seen);
  const auto more = static_cast<double>(seen);
  const Point3 mean =
      (before * landmark.concentration * landmark.to_eye + more * concentration * to_eye) / (before + more);
  landmark.concentration = std::min(mean.norm(), 1.0);
  constexpr double kNoDirection = 1e-9;
  landmark.to_eye = landmark.concentration > kNoDirection ? Point3(mean.normalized()) : landmark.to_eye;
}

void add_view(Landmark& landmark, const LandmarkView& view, const FusionParams& params) {
  const double same_side = std::cos(params.view_cluster_rad);
  LandmarkView* nearest = &landmark.views.front();
  for (LandmarkView& known : landmark.views) {
    nearest = known.to_eye.dot(view.to_eye) > nearest->to_eye.dot(view.to_eye) ? &known : nearest;
  }
  const bool known_side = params.running_mean || nearest->to_eye.dot(view.to_eye) >= same_side;
  if (known_side) {
    nearest->seen += view.seen;
  } else if (landmark.views.size() < kMaxViews) {
    landmark.views.push_back(view);
  }
}

}  // namespace

Matrix3 Landmark::covariance() const {
  const Matrix3 inverse = information.inverse();
  return 0.5 * (inverse + inverse.transpose());
}

Landmark make_landmark(const SeenPoint& point, const vision::Descriptor& descriptor) {
  Landmark landmark;
  landmark.p_map = point.map.p;
  landmark.information = inverse_of(point.map.covariance);
  landmark.to_eye = point.to_eye;
  landmark.scale_m = point.scale_m;
  landmark.views = {{descriptor, point.to_eye, 1}};
  landmark.seen = 1;
  landmark.expected = 1;
  return landmark;
}

void fuse(Landmark& landmark, const SeenPoint& point, const vision::Descriptor& descriptor,
          const FusionParams& params) {
  fuse_place(landmark, point.map.p, inverse_of(point.map.covariance), 1, params);
  fuse_direction(landmark, point.to_eye, 1.0, 1);
  landmark.scale_m += (point.scale_m - landmark.scale_m) / static_cast<double>(landmark.seen + 1);
  add_view(landmark, {descriptor, point.to_eye, 1}, params);
  ++landmark.seen;
}

void fuse(Landmark& landmark, const Landmark& other, const FusionParams& params) {
  fuse_place(landmark, other.p_map, other.information, other.seen, params);
  fuse_direction(landmark, other.to_eye, other.concentration, other.seen);
  const double share = static_cast<double>(other.seen) / static_cast<double>(landmark.seen + other.seen);
  landmark.scale_m += share * (other.scale_m - landmark.scale_m);
  for (const LandmarkView& view : other.views) {
    add_view(landmark, view, params);
  }
  landmark.seen += other.seen;
  landmark.expected += other.expected;
}

}  // namespace seeker::localize
