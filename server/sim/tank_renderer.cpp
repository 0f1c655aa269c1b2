#include "server/sim/tank_renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Geometry>

#include "common/core/angle.hpp"

namespace seeker::sim {
namespace {

using Eigen::Vector3d;

constexpr double kWhite = 255.0;
constexpr double kReference_m = 1.1;  ///< range at which the lamp lights a white patch fully

struct Surface3 {
  double distance_m = 0.0;
  Vector3d normal = Vector3d::UnitZ();
};

int sides_of(const TankSolid& solid) { return solid.shape == SolidKind::kTriangularPrism ? 3 : 4; }

/// Distance of a prism's axis from a side, of a regular polygon with sides of `size_m`.
double inner_m(const TankSolid& solid) { return 0.5 * solid.size_m / std::tan(kPi / sides_of(solid)); }
double outer_m(const TankSolid& solid) { return 0.5 * solid.size_m / std::sin(kPi / sides_of(solid)); }

/// Where a ray enters a convex solid that stands on the floor.
class Body {
 public:
  explicit Body(const TankSolid& solid)
      : albedo_(solid.albedo),
        centre_(solid.world_T_solid.x_m, solid.world_T_solid.y_m, half_height_m(solid)),
        cos_yaw_(std::cos(solid.world_T_solid.theta_rad)),
        sin_yaw_(std::sin(solid.world_T_solid.theta_rad)) {
    const double half_m = half_height_m(solid);
    if (is_prism(solid.shape)) {
      for (int i = 0; i < sides_of(solid); ++i) {
        const double angle = kTwoPi * i / sides_of(solid);
        planes_.push_back({Vector3d(std::cos(angle), std::sin(angle), 0.0), inner_m(solid)});
      }
      planes_.push_back({Vector3d::UnitZ(), half_m});
      planes_.push_back({-Vector3d::UnitZ(), half_m});
      reach_m_ = std::hypot(half_m, outer_m(solid));
      return;
    }
    axes_ = Vector3d::Constant(solid.size_m);
    if (solid.shape == SolidKind::kEllipsoid) {
      axes_.x() *= solid.elongation;
    }
    reach_m_ = axes_.maxCoeff();
  }

  [[nodiscard]] double albedo() const { return albedo_; }

  /// `direction` has length 1.
  [[nodiscard]] std::optional<Surface3> meet(const Vector3d& from, const Vector3d& direction) const {
    const Vector3d to_centre = centre_ - from;
    const double along = to_centre.dot(direction);
    if (along < -reach_m_ || to_centre.squaredNorm() - along * along > reach_m_ * reach_m_) {
      return std::nullopt;
    }
    const Vector3d o = to_own(-to_centre);
    const Vector3d d = to_own(direction);
    std::optional<Surface3> hit = planes_.empty() ? meet_ellipsoid(o, d) : meet_prism(o, d);
    if (hit) {
      const Vector3d& n = hit->normal;
      hit->normal = {cos_yaw_ * n.x() - sin_yaw_ * n.y(), sin_yaw_ * n.x() + cos_yaw_ * n.y(), n.z()};
    }
    return hit;
  }

 private:
  struct Plane {
    Vector3d normal;
    double offset_m;
  };

  [[nodiscard]] Vector3d to_own(const Vector3d& v) const {
    return {cos_yaw_ * v.x() + sin_yaw_ * v.y(), cos_yaw_ * v.y() - sin_yaw_ * v.x(), v.z()};
  }

  [[nodiscard]] std::optional<Surface3> meet_ellipsoid(const Vector3d& origin, const Vector3d& direction) const {
    const Vector3d o = origin.cwiseQuotient(axes_);
    const Vector3d d = direction.cwiseQuotient(axes_);
    const double b = o.dot(d);
    const double disc = b * b - d.squaredNorm() * (o.squaredNorm() - 1.0);
    if (disc < 0.0) {
      return std::nullopt;
    }
    const double t = (-b - std::sqrt(disc)) / d.squaredNorm();
    if (t <= 0.0) {
      return std::nullopt;
    }
    const Vector3d p = origin + t * direction;
    return Surface3{t, p.cwiseQuotient(axes_.cwiseProduct(axes_)).normalized()};
  }

  [[nodiscard]] std::optional<Surface3> meet_prism(const Vector3d& origin, const Vector3d& direction) const {
    double in = 0.0;
    double out = std::numeric_limits<double>::infinity();
    Vector3d normal = Vector3d::UnitZ();
    for (const Plane& plane : planes_) {
      const double along = plane.normal.dot(direction);
      const double rest = plane.offset_m - plane.normal.dot(origin);
      if (along == 0.0) {
        if (rest < 0.0) {
          return std::nullopt;
        }
        continue;
      }
      const double t = rest / along;
      if (along > 0.0) {
        out = std::min(out, t);
      } else if (t > in) {
        in = t;
        normal = plane.normal;
      }
    }
    return in > 0.0 && in < out ? std::optional<Surface3>({in, normal}) : std::nullopt;
  }

  double albedo_;
  Vector3d centre_;
  double cos_yaw_;
  double sin_yaw_;
  double reach_m_ = 0.0;  ///< nothing of it is farther from its middle
  Vector3d axes_ = Vector3d::Ones();
  std::vector<Plane> planes_;
};

/// The walls as points below each other's directions, joined by straight pieces.
class Walls {
 public:
  Walls(const TankWalls& walls, const TankEye& eye) : walls_(walls) {
    for (std::size_t i = 0; i < walls.distance_m.size(); ++i) {
      const double angle = eye.heading_rad + walls.first_rad + walls.step_rad * static_cast<double>(i);
      points_.emplace_back(eye.position.head<2>() + walls.distance_m[i] * Point2(std::cos(angle), std::sin(angle)));
    }
  }

  /// Along the floor, towards a direction relative to the eye's heading.
  [[nodiscard]] std::optional<Surface3> meet(double bearing_rad) const {
    const double at = points_.size() < 2 ? -1.0 : (bearing_rad - walls_.first_rad) / walls_.step_rad;
    if (at < 0.0 || at >= static_cast<double>(points_.size() - 1)) {
      return std::nullopt;
    }
    const auto i = static_cast<std::size_t>(at);
    const double share = at - static_cast<double>(i);
    // 1 / distance of a straight wall is nearly linear in the direction.
    const double inverse = (1.0 - share) / walls_.distance_m[i] + share / walls_.distance_m[i + 1];
    const Point2 along = points_[i + 1] - points_[i];
    const Vector3d normal(-along.y(), along.x(), 0.0);
    return Surface3{1.0 / inverse, normal.norm() > 0.0 ? normal.normalized() : Vector3d(Vector3d::UnitZ())};
  }

 private:
  const TankWalls& walls_;
  std::vector<Point2> points_;
};

/// Light before blur and noise, for one picture.
class Tank {
 public:
  Tank(const std::vector<TankSolid>& solids, const TankEye& eye, const TankWalls& walls, const TurbidWater& water)
      : eye_(eye), water_(water), bodies_(solids.begin(), solids.end()), walls_(walls, eye) {
    const double c = std::cos(eye.tilt_rad);
    ahead_ = {c * std::cos(eye.heading_rad), c * std::sin(eye.heading_rad), -std::sin(eye.tilt_rad)};
    right_ = ahead_.cross(Vector3d::UnitZ()).normalized();
    down_ = ahead_.cross(right_);
    lamp_ = eye.position + water.lamp_right_m * right_ - water.lamp_up_m * down_;
  }

  [[nodiscard]] double at(int u, int v) const {
    const double x = (u - kTankWidth_px / 2.0 - eye_.off_u_px) / kTankFocal_px;
    const double y = (v - kTankHeight_px / 2.0 - eye_.off_v_px) / kTankFocal_px;
    const Vector3d direction = (ahead_ + x * right_ + y * down_).normalized();
    const double beam = beam_at(u, v);
    Surface3 nearest{std::numeric_limits<double>::infinity(), Vector3d::UnitZ()};
    double albedo = water_.floor_albedo;
    if (direction.z() < 0.0) {
      nearest.distance_m = eye_.position.z() / -direction.z();
    }
    const double level = direction.head<2>().norm();
    const double left = -x;
    if (const auto wall = walls_.meet(std::atan2(left, std::cos(eye_.tilt_rad) - y * std::sin(eye_.tilt_rad)));
        wall && wall->distance_m < level * nearest.distance_m) {
      nearest = {wall->distance_m / level, wall->normal};
    }
    for (const Body& body : bodies_) {
      const std::optional<Surface3> hit = body.meet(eye_.position, direction);
      if (hit && hit->distance_m < nearest.distance_m) {
        nearest = *hit;
        albedo = body.albedo();
      }
    }
    if (std::isinf(nearest.distance_m)) {
      return water_.veil * beam;
    }
    return seen(eye_.position + nearest.distance_m * direction, nearest, albedo, beam);
  }

 private:
  [[nodiscard]] double beam_at(int u, int v) const {
    const double x = 2.0 * u / kTankWidth_px - 1.0 - water_.lamp_offset_u;
    const double y = 2.0 * v / kTankHeight_px - 1.0 - water_.lamp_offset_v;
    return std::exp(-0.25 * water_.beam * (x * x + y * y));
  }

  /// Brightness of a patch through the water: less of its own light, more of the water's.
  [[nodiscard]] double seen(const Vector3d& p, const Surface3& surface, double albedo, double beam) const {
    const Vector3d to_lamp = lamp_ - p;
    const double lamp_m = to_lamp.norm();
    const Vector3d towards = to_lamp / lamp_m;
    constexpr double kOff_m = 1e-4;
    const Vector3d above = p + kOff_m * surface.normal;
    const bool shadow = std::any_of(bodies_.begin(), bodies_.end(),
                                    [&](const Body& body) { return body.meet(above, towards).has_value(); });
    const double lit =
        shadow ? 0.0 : std::max(0.0, surface.normal.dot(towards)) * kReference_m * kReference_m / (lamp_m * lamp_m);
    const double own = albedo * (water_.ambient + (1.0 - water_.ambient) * lit * beam);
    const double kept = std::exp(-water_.attenuation_per_m * surface.distance_m);
    const double arrived = std::exp(-water_.attenuation_per_m * (lamp_m - kReference_m));
    return own * kept * arrived + water_.veil * (1.0 - kept) * (0.5 + 0.5 * beam);
  }

  TankEye eye_;
  TurbidWater water_;
  std::vector<Body> bodies_;
  Walls walls_;
  Vector3d ahead_ = Vector3d::UnitX();
  Vector3d right_ = Vector3d::UnitX();
  Vector3d down_ = Vector3d::UnitX();
  Vector3d lamp_ = Vector3d::Zero();
};

std::vector<float> gaussian(double sigma_px) {
  constexpr double kReach = 3.0;
  const int half = std::max(1, static_cast<int>(std::ceil(kReach * sigma_px)));
  std::vector<float> kernel;
  double sum = 0.0;
  for (int i = -half; i <= half; ++i) {
    const double w = sigma_px > 0.0 ? std::exp(-0.5 * i * i / (sigma_px * sigma_px)) : (i == 0 ? 1.0 : 0.0);
    kernel.push_back(static_cast<float>(w));
    sum += w;
  }
  for (float& w : kernel) {
    w /= static_cast<float>(sum);
  }
  return kernel;
}

/// One direction of a separable blur; the border repeats. `step` to the next pixel of a line, `pitch` to the next line.
void blur_lines(const std::vector<float>& in, std::vector<float>& out, const std::vector<float>& kernel, int length,
                int lines, int step, int pitch) {
  const int half = static_cast<int>(kernel.size()) / 2;
  for (int line = 0; line < lines; ++line) {
    for (int i = 0; i < length; ++i) {
      float sum = 0.0F;
      for (int k = -half; k <= half; ++k) {
        const int at = std::clamp(i + k, 0, length - 1);
        sum += kernel[static_cast<std::size_t>(k + half)] * in[static_cast<std::size_t>(line * pitch + at * step)];
      }
      out[static_cast<std::size_t>(line * pitch + i * step)] = sum;
    }
  }
}

}  // namespace

double half_height_m(const TankSolid& solid) {
  return is_prism(solid.shape) ? 0.5 * solid.elongation * solid.size_m : solid.size_m;
}

std::vector<Point2> outline(const TankSolid& solid) {
  std::vector<Point2> corners;
  if (is_prism(solid.shape)) {
    const int sides = sides_of(solid);
    corners.reserve(static_cast<std::size_t>(sides));
    for (int i = 0; i < sides; ++i) {
      const double angle = kTwoPi * (i + 0.5) / sides;
      corners.emplace_back(solid.world_T_solid * (outer_m(solid) * Point2(std::cos(angle), std::sin(angle))));
    }
    return corners;
  }
  constexpr int kCorners = 24;
  const double long_m = solid.size_m * (solid.shape == SolidKind::kEllipsoid ? solid.elongation : 1.0);
  corners.reserve(kCorners);
  for (int i = 0; i < kCorners; ++i) {
    const double angle = kTwoPi * i / kCorners;
    corners.emplace_back(solid.world_T_solid * Point2(long_m * std::cos(angle), solid.size_m * std::sin(angle)));
  }
  return corners;
}

Image render_tank(const std::vector<TankSolid>& solids, const TankEye& eye, const TankWalls& walls,
                  const TurbidWater& water, Rng& rng) {
  const Tank tank(solids, eye, walls, water);
  std::vector<float> light;
  light.reserve(std::size_t{kTankWidth_px} * kTankHeight_px);
  for (int v = 0; v < kTankHeight_px; ++v) {
    for (int u = 0; u < kTankWidth_px; ++u) {
      light.push_back(static_cast<float>(kWhite * water.gain * tank.at(u, v)));
    }
  }
  const std::vector<float> kernel = gaussian(water.blur_px);
  std::vector<float> rows(light.size());
  blur_lines(light, rows, kernel, kTankWidth_px, kTankHeight_px, 1, kTankWidth_px);
  blur_lines(rows, light, kernel, kTankHeight_px, kTankWidth_px, kTankWidth_px, 1);
  Image image(kTankWidth_px, kTankHeight_px, 1);
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double grey = static_cast<double>(light[i]) + rng.normal(water.noise);
    image.data()[i] = static_cast<std::uint8_t>(std::clamp(grey + 0.5, 0.0, kWhite));
  }
  return image;
}

}  // namespace seeker::sim
