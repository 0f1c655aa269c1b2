/// \file
/// World files (config/worlds/*.yaml) and their conversion to sim::World.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/config/fields.hpp"
#include "common/core/result.hpp"
#include "server/options/target_options.hpp"
#include "server/sim/furniture.hpp"
#include "server/sim/world.hpp"

namespace seeker::sim {

// Found beside the structs they describe (see config::Fields).
void describe(config::Fields& f, Lighting& lighting);
void describe(config::Fields& f, Surface& surface);
void describe(config::Fields& f, TableShape& shape);
void describe(config::Fields& f, BookcaseShape& shape);
void describe(config::Fields& f, TurbidWater& water);

}  // namespace seeker::sim

namespace seeker::options {

/// An opening in a wall of a single leg: `at_m` is the distance from its first corner to the middle of the
/// opening. Above `height_m` the wall continues.
struct DoorFile {
  double at_m = 0.0;
  double width_m = 0.95;
  double height_m = 2.05;
};
void describe(config::Fields& f, DoorFile& door);

/// Walls along a line of corners.
struct WallFile {
  Polygon path;
  bool closed = false;  ///< the last corner joins the first
  double thickness_m = 0.0;
  double z_min_m = 0.0;
  double z_max_m = 2.6;
  sim::Surface surface;
  std::vector<DoorFile> doors;
};
void describe(config::Fields& f, WallFile& wall);

struct BoxFile {
  Pose2 pose;
  Point2 size_m = Point2(1.0, 1.0);
  Point2 z_m = Point2(0.0, 1.0);  ///< lower and upper height
  sim::Surface surface;
  std::string object;  ///< parts of one piece of furniture share a name
};
void describe(config::Fields& f, BoxFile& box);

struct TableFile {
  Pose2 pose;
  sim::TableShape shape;
  sim::Surface surface;
  std::string object;  ///< empty: the table is a piece of its own
};
void describe(config::Fields& f, TableFile& table);

struct BookcaseFile {
  Pose2 pose;  ///< pose in the world; the books face along its y axis
  sim::BookcaseShape shape;
  sim::Surface surface;
  std::string object;  ///< empty: a piece of its own
};
void describe(config::Fields& f, BookcaseFile& bookcase);

struct ChairFile {
  Pose2 pose;
  sim::Surface surface;
  std::string object;  ///< empty: a piece of its own
};
void describe(config::Fields& f, ChairFile& chair);

struct CylinderFile {
  Point2 centre = Point2::Zero();
  double radius_m = 0.2;
  Point2 z_m = Point2(0.0, 1.0);
  sim::Surface surface;
};
void describe(config::Fields& f, CylinderFile& cylinder);

struct PlacedTargetFile {
  std::string file;  ///< a target file, relative to the world file
  Pose2 pose;
};
void describe(config::Fields& f, PlacedTargetFile& target);

/// A solid on the floor of a tank: see sim::TankSolid.
struct SolidFile {
  SolidKind shape = SolidKind::kSphere;
  Pose2 pose;
  double size_m = 0.1;
  double elongation = 1.0;
  double albedo = 0.75;
};
void describe(config::Fields& f, SolidFile& solid);

struct PersonFile {
  Polygon waypoints;
  double speed_m_s = 0.7;
  double radius_m = 0.22;
  double wait_m = 0.6;
};
void describe(config::Fields& f, PersonFile& person);

struct StartFile {
  Pose2 pose;
};
void describe(config::Fields& f, StartFile& start);

/// Rearranges the furniture: see sim::move_objects.
struct MovedFile {
  double share = 0.0;  ///< share of the objects that are moved; 0: none
  std::uint64_t seed = 1;
};
void describe(config::Fields& f, MovedFile& moved);

/// The content of the file.
struct WorldFile {
  std::string base;  ///< name of another world file in the same folder, whose values this one overrides
  std::string name;
  Point2 min_corner = Point2::Zero();
  Point2 max_corner = Point2(5.0, 5.0);
  sim::Lighting lighting;
  sim::Surface floor{0.55, 0.10, 0.25, 1};
  std::vector<StartFile> starts;
  std::vector<WallFile> walls;
  std::vector<BoxFile> boxes;
  std::vector<TableFile> tables;
  std::vector<BookcaseFile> bookcases;
  std::vector<ChairFile> chairs;
  std::vector<CylinderFile> cylinders;
  std::vector<PlacedTargetFile> targets;
  std::vector<SolidFile> solids;
  sim::TurbidWater water;
  std::vector<PersonFile> people;
  bool people_walk = false;
  std::uint64_t pattern_seed = 0;  ///< seed of the textures of all surfaces
  MovedFile moved;
};
void describe(config::Fields& f, WorldFile& world);

/// Loads the target of a file that a world names.
using TargetLoader = std::function<Result<TargetDescription>(const std::string& file)>;

/// Parses the text of one world file; keys that it does not have keep the values of `defaults`. No file is opened.
[[nodiscard]] Result<WorldFile> parse_world(std::string_view text, const std::string& name, WorldFile defaults = {},
                                            const std::vector<std::string>& overrides = {});
/// Builds a world: cuts doors into walls, builds tables, loads pictures, and validates the result.
[[nodiscard]] Result<sim::World> build_world(const WorldFile& file, const TargetLoader& load_target);

/// Loads a world file with its base, targets and pictures. `overrides` are "key.path=value".
[[nodiscard]] Result<sim::World> load_world(const std::filesystem::path& path,
                                            const std::vector<std::string>& overrides = {});

}  // namespace seeker::options
