/// \file
/// Objects of the simulated building. Plain values in the frame `world` (metres, radians, z up from the floor);
/// server/options/world_options.hpp reads them from YAML.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "server/sim/turbid_water.hpp"

namespace seeker::sim {

/// Appearance of a surface for the cameras: a cut of a multi-octave noise picture around a mean brightness.
struct Surface {
  double albedo = 0.72;          ///< mean reflectance, 0..1
  double contrast = 0.12;        ///< amplitude of the texture, 0: blank
  double feature_size_m = 0.12;  ///< size of the coarsest blotch of the texture
  std::uint32_t pattern = 0;     ///< selects the cut, so that no two walls look the same

  friend bool operator==(const Surface&, const Surface&) = default;
};

/// A wall from a to b; with a thickness it is a solid around that line.
struct Wall {
  Point2 a = Point2::Zero();
  Point2 b = Point2::Zero();
  double thickness_m = 0.0;
  double z_min_m = 0.0;  ///< lower edge; above zero: a lintel or a shelf
  double z_max_m = 2.6;
  Surface surface;
};

/// A rotated box: furniture, or a part of it (a table is a top and four legs).
struct Box {
  Pose2 world_T_box;      ///< centre of the footprint
  double length_m = 1.0;  ///< along its x axis
  double width_m = 1.0;   ///< along its y axis
  double z_min_m = 0.0;
  double z_max_m = 1.0;
  Surface surface;
  std::string object{};  ///< parts of one piece of furniture share a name; empty: a separate piece
};

struct Cylinder {
  Point2 centre = Point2::Zero();
  double radius_m = 0.2;
  double z_min_m = 0.0;
  double z_max_m = 1.0;
  Surface surface;
};

/// The object that a search looks for. With depth it is a solid that shows its picture on all four sides; with depth 0
/// it is a poster that shows it towards its heading.
struct Target {
  std::string name;
  Pose2 world_T_target;    ///< centre of the footprint; x axis = direction that the front faces
  double width_m = 0.30;   ///< along its y axis
  double depth_m = 0.30;   ///< along its x axis; 0: a poster
  double height_m = 0.70;  ///< height of the picture
  double z_min_m = 0.05;
  Image picture;  ///< 1 or 3 channels; never empty
};

/// A person who walks to and fro along a line of places, and waits while the robot blocks the path.
struct PersonPath {
  std::vector<Point2> waypoints;  ///< at least two
  double speed_m_s = 0.7;
  double radius_m = 0.22;
  double height_m = 1.75;
  double wait_m = 0.6;  ///< distance that the person keeps from the robot's edge
  Surface surface{0.35, 0.1, 0.3, 77};
};

struct Lighting {
  double gain = 1.0;                       ///< factor of all brightness
  Point2 gradient_per_m = Point2::Zero();  ///< relative change of brightness over the floor
  double direction_rad = 0.6;              ///< direction that the side light comes from
  double directional = 0.15;               ///< share of the side light
  double ceiling_albedo = 0.85;            ///< brightness above the walls
  double exposure_jitter = 0.04;           ///< relative sigma of the exposure from picture to picture
  double flicker_period_s = 37.0;          ///< period of the slow variation of the lamps
  double flicker = 0.05;                   ///< relative amplitude of that variation
};

/// A whole world. The frame `map` of a robot that starts in it is the start pose, not the frame `world`.
struct World {
  std::string name;
  Point2 min_corner = Point2::Zero();  ///< lower corner of the bounds; no object may lie outside
  Point2 max_corner = Point2(5.0, 5.0);
  std::vector<Wall> walls;
  std::vector<Box> boxes;
  std::vector<Cylinder> cylinders;
  std::vector<Target> targets;
  std::vector<TankSolid> solids;  ///< on the floor; only the camera of a tank sees their shape
  TurbidWater water;              ///< water in front of the camera of a tank
  std::vector<PersonPath> people;
  bool people_walk = false;  ///< people exist only when this is on
  Lighting lighting;
  Surface floor{0.55, 0.10, 0.25, 1};
  std::uint64_t pattern_seed = 0;  ///< gives the same building other textures; 0: those of the surfaces alone
  std::vector<Pose2> starts;       ///< at least one; the first is the default
};

inline constexpr double kMaxWorldSide_m = 500.0;
inline constexpr std::size_t kMaxWorldItems = 20000;

/// Refuses worlds that cannot be simulated: values that are not finite, empty bounds, objects outside them or without
/// size, no start pose, a target without a picture. The sentence names the item.
[[nodiscard]] Status validate(const World& world);

}  // namespace seeker::sim
