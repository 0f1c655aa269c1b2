#include "server/sim/turbid_water.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "common/core/angle.hpp"

namespace seeker::sim {
namespace {

using Eigen::Vector3d;

constexpr double kFocal_px = 700.0;
constexpr double kWhite = 255.0;
constexpr double kReference_m = 1.1;  ///< range at which the lamp lights a white patch fully

struct Surface3 {
  double distance_m = 0.0;
  Vector3d normal = Vector3d::UnitZ();
};

/// Where a ray enters a convex solid around the origin of its own frame.
class Body {
 public:
  explicit Body(const SolidView& view) : view_(view) {
    const int sides = view.shape == SolidShape::kTriangularPrism ? 3 : 4;
    if (view.shape == SolidShape::kTriangularPrism || view.shape == SolidShape::kQuadrangularPrism) {
      half_height_m_ = 0.5 * view.elongation * view.size_m;
      const double inner_m = 0.5 * view.size_m / std::tan(kPi / sides);  // from the axis to a side
      for (int i = 0; i < sides; ++i) {
        const double angle = kTwoPi * i / sides;
        planes_.push_back({Vector3d(std::cos(angle), std::sin(angle), 0.0), inner_m});
      }
      planes_.push_back({Vector3d::UnitZ(), half_height_m_});
      planes_.push_back({-Vector3d::UnitZ(), half_height_m_});
      return;
    }
    half_height_m_ = view.size_m;
    axes_ = Vector3d::Constant(view.size_m);
    if (view.shape == SolidShape::kEllipsoid) {
      axes_.x() *= view.elongation;
    }
  }

  [[nodiscard]] double half_height_m() const { return half_height_m_; }

  [[nodiscard]] std::optional<Surface3> meet(const Vector3d& origin, const Vector3d& direction) const {
    return planes_.empty() ? meet_ellipsoid(origin, direction) : meet_prism(origin, direction);
  }

 private:
  struct Plane {
    Vector3d normal;
    double offset_m;
  };

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

  SolidView view_;
  double half_height_m_ = 0.0;
  Vector3d axes_ = Vector3d::Ones();
  std::vector<Plane> planes_;
};

/// Light before blur and noise, for one picture.
class Tank {
 public:
  Tank(const SolidView& view, const TurbidWater& water) : view_(view), water_(water), body_(view) {
    const double c = std::cos(view.elevation_rad);
    const double s = std::sin(view.elevation_rad);
    const Vector3d from(c * std::cos(view.yaw_rad), c * std::sin(view.yaw_rad), s);
    ahead_ = -from;
    right_ = ahead_.cross(Vector3d::UnitZ()).normalized();
    down_ = ahead_.cross(right_);
    eye_ = view.distance_m * from;
    lamp_ = eye_ + water.lamp_right_m * right_ - water.lamp_up_m * down_;
  }

  [[nodiscard]] double at(int u, int v) const {
    const double x = (u - kTankWidth_px / 2.0 - view_.off_u_px) / kFocal_px;
    const double y = (v - kTankHeight_px / 2.0 - view_.off_v_px) / kFocal_px;
    const Vector3d direction = (ahead_ + x * right_ + y * down_).normalized();
    const double beam = beam_at(u, v);
    const std::optional<Surface3> hit = body_.meet(eye_, direction);
    if (hit) {
      return seen(eye_ + hit->distance_m * direction, hit->normal, view_.albedo, hit->distance_m, beam);
    }
    if (direction.z() < 0.0) {
      const double distance_m = (eye_.z() + body_.half_height_m()) / -direction.z();
      return seen(eye_ + distance_m * direction, Vector3d::UnitZ(), water_.floor_albedo, distance_m, beam);
    }
    return water_.veil * beam;
  }

 private:
  [[nodiscard]] double beam_at(int u, int v) const {
    const double x = 2.0 * u / kTankWidth_px - 1.0 - water_.lamp_turn_u;
    const double y = 2.0 * v / kTankHeight_px - 1.0 - water_.lamp_turn_v;
    return std::exp(-0.25 * water_.beam * (x * x + y * y));
  }

  /// Brightness of a patch through the water: less of its own light, more of the water's.
  [[nodiscard]] double seen(const Vector3d& p, const Vector3d& normal, double albedo, double range_m,
                            double beam) const {
    const Vector3d to_lamp = lamp_ - p;
    const double lamp_m = to_lamp.norm();
    const Vector3d towards = to_lamp / lamp_m;
    constexpr double kOff_m = 1e-4;
    const bool shadow = body_.meet(p + kOff_m * normal, towards).has_value();
    const double lit =
        shadow ? 0.0 : std::max(0.0, normal.dot(towards)) * kReference_m * kReference_m / (lamp_m * lamp_m);
    const double own = albedo * (water_.ambient + (1.0 - water_.ambient) * lit * beam);
    const double kept = std::exp(-water_.attenuation_per_m * range_m);
    const double arrived = std::exp(-water_.attenuation_per_m * (lamp_m - kReference_m));
    return own * kept * arrived + water_.veil * (1.0 - kept) * (0.5 + 0.5 * beam);
  }

  SolidView view_;
  TurbidWater water_;
  Body body_;
  Vector3d eye_ = Vector3d::Zero();
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

Image render_solid(const SolidView& view, const TurbidWater& water, Rng& rng) {
  const Tank tank(view, water);
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

SolidView draw_view(SolidShape shape, Rng& rng) {
  SolidView view;
  view.shape = shape;
  const bool prism = shape == SolidShape::kTriangularPrism || shape == SolidShape::kQuadrangularPrism;
  view.size_m = prism ? rng.uniform(0.14, 0.24) : rng.uniform(0.07, 0.13);
  view.elongation = prism ? rng.uniform(0.8, 1.6) : (shape == SolidShape::kEllipsoid ? rng.uniform(1.5, 2.2) : 1.0);
  view.yaw_rad = rng.uniform(-kPi, kPi);
  view.elevation_rad = rng.uniform(deg_to_rad(20.0), deg_to_rad(60.0));
  view.distance_m = rng.uniform(0.9, 1.3);
  view.off_u_px = rng.uniform(-90.0, 90.0);
  view.off_v_px = rng.uniform(-60.0, 60.0);
  view.albedo = rng.uniform(0.55, 0.9);
  return view;
}

TurbidWater draw_water(Rng& rng) {
  TurbidWater water;
  water.attenuation_per_m = rng.uniform(0.3, 1.0);
  water.veil = rng.uniform(0.12, 0.4);
  water.blur_px = rng.uniform(0.8, 2.2);
  water.noise = rng.uniform(2.0, 6.0);
  water.floor_albedo = rng.uniform(0.08, 0.22);
  water.ambient = rng.uniform(0.2, 0.45);
  water.lamp_right_m = rng.uniform(-0.3, 0.3);
  water.lamp_up_m = rng.uniform(0.1, 0.4);
  water.lamp_turn_u = rng.uniform(-0.5, 0.5);
  water.lamp_turn_v = rng.uniform(-0.5, 0.5);
  water.beam = rng.uniform(0.5, 2.5);
  water.gain = rng.uniform(0.9, 1.4);
  return water;
}

}  // namespace seeker::sim
