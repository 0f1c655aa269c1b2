#include "server/sim/world.hpp"

#include <algorithm>
#include <cmath>

#include "server/sim/tank_renderer.hpp"

namespace seeker::sim {
namespace {

/// Collects the first complaint about a world.
class Checker {
 public:
  explicit Checker(const World& world) : world_(world) {}

  void require(bool ok, const std::string& item, const std::string& why) {
    if (!ok && status_) {
      status_ = fail(Errc::kInvalidArgument, "world '" + world_.name + "': " + item + " " + why);
    }
  }
  void inside(const Point2& p, const std::string& item) {
    constexpr double kSlack_m = 1e-6;
    const bool ok = p.allFinite() && (p - world_.min_corner).minCoeff() >= -kSlack_m &&
                    (world_.max_corner - p).minCoeff() >= -kSlack_m;
    require(ok, item, "lies outside the bounds of the world; move it or enlarge the bounds");
  }
  void size(double value, const std::string& item, const char* what) {
    require(std::isfinite(value) && value > 0.0 && value <= kMaxWorldSide_m, item,
            std::string("needs a ") + what + " above 0");
  }
  void heights(double z_min, double z_max, const std::string& item) {
    require(std::isfinite(z_min) && std::isfinite(z_max) && z_min >= 0.0 && z_max > z_min && z_max <= kMaxWorldSide_m,
            item, "needs 0 <= z_min < z_max");
  }
  void surface(const Surface& s, const std::string& item) {
    require(s.albedo >= 0.0 && s.albedo <= 1.0 && s.contrast >= 0.0 && s.contrast <= 1.0, item,
            "needs albedo and contrast from 0 to 1");
    constexpr double kSmallestFeature_m = 1e-3;
    require(s.feature_size_m >= kSmallestFeature_m && s.feature_size_m <= kMaxWorldSide_m, item,
            "needs a feature_size of at least 1 mm");
  }
  [[nodiscard]] const Status& status() const { return status_; }

 private:
  const World& world_;
  Status status_;
};

std::string item(const char* kind, std::size_t index) { return std::string(kind) + " " + std::to_string(index); }

void check_bounds(const World& w, Checker& c) {
  const Point2 side = w.max_corner - w.min_corner;
  c.require(w.min_corner.allFinite() && w.max_corner.allFinite() && side.minCoeff() > 0.0 &&
                side.maxCoeff() <= kMaxWorldSide_m,
            "bounds", "must be finite, not empty and at most 500 m on a side");
  const std::size_t items =
      w.walls.size() + w.boxes.size() + w.cylinders.size() + w.targets.size() + w.solids.size() + w.people.size();
  c.require(items <= kMaxWorldItems, "number of items", "is over the limit of " + std::to_string(kMaxWorldItems));
  c.surface(w.floor, "floor");
  const Lighting& l = w.lighting;
  c.require(std::isfinite(l.gain) && l.gain > 0.0 && l.gradient_per_m.allFinite() && std::isfinite(l.direction_rad) &&
                l.directional >= 0.0 && l.directional <= 1.0 && l.ceiling_albedo >= 0.0 && l.ceiling_albedo <= 1.0 &&
                l.exposure_jitter >= 0.0 && l.exposure_jitter <= 1.0 && l.flicker >= 0.0 && l.flicker < 1.0 &&
                l.flicker_period_s > 0.0,
            "lighting", "has a value outside its range");
  c.require(!w.starts.empty(), "starts", "must hold at least one pose");
  for (std::size_t i = 0; i < w.starts.size(); ++i) {
    c.require(is_finite(w.starts[i]), item("start", i), "is not finite");
    c.inside(w.starts[i].translation(), item("start", i));
  }
}

void check_solids(const World& w, Checker& c) {
  for (std::size_t i = 0; i < w.walls.size(); ++i) {
    const Wall& wall = w.walls[i];
    c.inside(wall.a, item("wall", i));
    c.inside(wall.b, item("wall", i));
    c.size((wall.b - wall.a).norm(), item("wall", i), "length");
    c.require(wall.thickness_m >= 0.0 && wall.thickness_m <= kMaxWorldSide_m, item("wall", i),
              "needs a thickness of 0 or more");
    c.heights(wall.z_min_m, wall.z_max_m, item("wall", i));
    c.surface(wall.surface, item("wall", i));
  }
  for (std::size_t i = 0; i < w.boxes.size(); ++i) {
    const Box& box = w.boxes[i];
    c.require(is_finite(box.world_T_box), item("box", i), "has no finite pose");
    c.inside(box.world_T_box.translation(), item("box", i));
    c.size(box.length_m, item("box", i), "length");
    c.size(box.width_m, item("box", i), "width");
    c.heights(box.z_min_m, box.z_max_m, item("box", i));
    c.surface(box.surface, item("box", i));
  }
  for (std::size_t i = 0; i < w.cylinders.size(); ++i) {
    const Cylinder& cylinder = w.cylinders[i];
    c.inside(cylinder.centre, item("cylinder", i));
    c.size(cylinder.radius_m, item("cylinder", i), "radius");
    c.heights(cylinder.z_min_m, cylinder.z_max_m, item("cylinder", i));
    c.surface(cylinder.surface, item("cylinder", i));
  }
}

void check_targets(const World& w, Checker& c) {
  for (const Target& target : w.targets) {
    const std::string name = "target '" + target.name + "'";
    c.require(!target.name.empty(), "target", "needs a name");
    c.require(is_finite(target.world_T_target), name, "has no finite pose");
    c.inside(target.world_T_target.translation(), name);
    c.size(target.width_m, name, "width");
    c.require(target.depth_m >= 0.0 && target.depth_m <= kMaxWorldSide_m, name, "needs a depth of 0 or more");
    c.size(target.height_m, name, "height");
    c.heights(target.z_min_m, target.z_min_m + target.height_m, name);
    c.require(!target.picture.empty(), name, "has no picture");
  }
}

void check_tank(const World& w, Checker& c) {
  for (std::size_t i = 0; i < w.solids.size(); ++i) {
    const TankSolid& solid = w.solids[i];
    c.require(is_finite(solid.world_T_solid), item("solid", i), "has no finite pose");
    c.size(solid.size_m, item("solid", i), "size");
    c.require(solid.elongation > 0.0 && solid.elongation <= 10.0, item("solid", i), "needs an elongation up to 10");
    c.require(solid.albedo >= 0.0 && solid.albedo <= 1.0, item("solid", i), "needs an albedo from 0 to 1");
    if (c.status()) {
      const std::vector<Point2> corners = outline(solid);
      std::for_each(corners.begin(), corners.end(), [&](const Point2& p) { c.inside(p, item("solid", i)); });
    }
  }
  const TurbidWater& water = w.water;
  const auto from_0 = [](double value, double most) { return value >= 0.0 && value <= most; };
  constexpr double kMost = 100.0;
  c.require(from_0(water.attenuation_per_m, kMost) && from_0(water.veil, 1.0) && from_0(water.blur_px, kMost) &&
                from_0(water.noise, kMost) && from_0(water.floor_albedo, 1.0) && from_0(water.ambient, 1.0) &&
                from_0(water.beam, kMost) && from_0(water.gain, kMost) && std::abs(water.lamp_right_m) <= kMost &&
                from_0(water.lamp_up_m, kMost) && std::abs(water.lamp_offset_u) <= kMost &&
                std::abs(water.lamp_offset_v) <= kMost,
            "water", "has a value outside its range");
}

void check_people(const World& w, Checker& c) {
  for (std::size_t i = 0; i < w.people.size(); ++i) {
    const PersonPath& person = w.people[i];
    c.require(person.waypoints.size() >= 2, item("person", i), "needs at least two waypoints");
    for (const Point2& p : person.waypoints) {
      c.inside(p, item("person", i));
    }
    c.size(person.speed_m_s, item("person", i), "speed");
    c.size(person.radius_m, item("person", i), "radius");
    c.size(person.height_m, item("person", i), "height");
    c.require(person.wait_m >= 0.0, item("person", i), "needs a waiting distance of 0 or more");
    c.surface(person.surface, item("person", i));
  }
}

}  // namespace

Status validate(const World& world) {
  Checker checker(world);
  check_bounds(world, checker);
  check_solids(world, checker);
  check_targets(world, checker);
  check_tank(world, checker);
  check_people(world, checker);
  return checker.status();
}

}  // namespace seeker::sim
