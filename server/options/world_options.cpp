#include "server/options/world_options.hpp"

#include <algorithm>
#include <utility>

#include "common/config/yaml.hpp"
#include "common/core/rng.hpp"
#include "server/sim/rearrange.hpp"

namespace seeker::sim {

void describe(config::Fields& f, Lighting& lighting) {
  f.field("gain", lighting.gain);
  f.field("gradient_per_m", lighting.gradient_per_m);
  f.angle_deg("direction_deg", lighting.direction_rad);
  f.field("directional", lighting.directional);
  f.field("ceiling_albedo", lighting.ceiling_albedo);
  f.field("exposure_jitter", lighting.exposure_jitter);
  f.field("flicker_period_s", lighting.flicker_period_s);
  f.field("flicker", lighting.flicker);
}

void describe(config::Fields& f, Surface& surface) {
  f.field("albedo", surface.albedo);
  f.field("contrast", surface.contrast);
  f.field("feature_size_m", surface.feature_size_m);
  auto pattern = static_cast<std::uint64_t>(surface.pattern);
  f.field("pattern", pattern);
  f.check("pattern", pattern <= 0xffffffffU, "must be below 2^32");
  surface.pattern = static_cast<std::uint32_t>(pattern);
}

void describe(config::Fields& f, TableShape& shape) {
  f.field("length_m", shape.length_m);
  f.field("width_m", shape.width_m);
  f.field("height_m", shape.height_m);
  f.field("thickness_m", shape.thickness_m);
  f.field("leg_m", shape.leg_m);
  f.check("leg_m",
          shape.leg_m > 0.0 && shape.thickness_m > 0.0 && shape.height_m > shape.thickness_m &&
              shape.length_m > shape.leg_m && shape.width_m > shape.leg_m,
          "the table must be larger than its legs and higher than its top is thick");
}

void describe(config::Fields& f, BookcaseShape& shape) {
  f.field("length_m", shape.length_m);
  f.field("depth_m", shape.depth_m);
  f.field("shelves", shape.shelves);
  f.field("shelf_m", shape.shelf_m);
  f.field("empty_share", shape.empty_share);
  constexpr int kMaxShelves = 20;
  constexpr double kSmallest_m = 0.1;
  f.check("shelves", shape.shelves >= 1 && shape.shelves <= kMaxShelves, "must be from 1 to 20");
  f.check("length_m", shape.length_m >= kSmallest_m && shape.depth_m >= kSmallest_m && shape.shelf_m >= kSmallest_m,
          "a bookcase needs a length, a depth and shelves of at least 0.1 m");
  f.check("empty_share", shape.empty_share >= 0.0 && shape.empty_share <= 1.0, "must be from 0 to 1");
}

void describe(config::Fields& f, TurbidWater& water) {
  f.field("attenuation_per_m", water.attenuation_per_m);
  f.field("veil", water.veil);
  f.field("blur_px", water.blur_px);
  f.field("noise", water.noise);
  f.field("floor_albedo", water.floor_albedo);
  f.field("ambient", water.ambient);
  f.field("lamp_right_m", water.lamp_right_m);
  f.field("lamp_up_m", water.lamp_up_m);
  f.field("lamp_offset_u", water.lamp_offset_u);
  f.field("lamp_offset_v", water.lamp_offset_v);
  f.field("beam", water.beam);
  f.field("gain", water.gain);
}

}  // namespace seeker::sim

namespace seeker::options {

void describe(config::Fields& f, DoorFile& door) {
  f.require("at_m");
  f.field("at_m", door.at_m);
  f.field("width_m", door.width_m);
  f.check("width_m", door.width_m > 0.0, "must be above 0");
  f.field("height_m", door.height_m);
}

void describe(config::Fields& f, WallFile& wall) {
  f.require("path");
  f.field("path", wall.path);
  f.check("path", wall.path.size() >= 2, "needs at least two corners");
  f.field("closed", wall.closed);
  f.field("thickness_m", wall.thickness_m);
  f.field("z_min_m", wall.z_min_m);
  f.field("z_max_m", wall.z_max_m);
  f.section("surface", wall.surface);
  f.list("doors", wall.doors);
  f.check("doors", wall.doors.empty() || (wall.path.size() == 2 && !wall.closed),
          "only a wall of two corners can have doors");
}

void describe(config::Fields& f, BoxFile& box) {
  f.require("pose");
  f.field("pose", box.pose);
  f.field("size_m", box.size_m);
  f.field("z_m", box.z_m);
  f.section("surface", box.surface);
  f.field("object", box.object);
}

void describe(config::Fields& f, TableFile& table) {
  f.require("pose");
  f.field("pose", table.pose);
  f.section("shape", table.shape);
  f.section("surface", table.surface);
  f.field("object", table.object);
}

void describe(config::Fields& f, BookcaseFile& bookcase) {
  f.require("pose");
  f.field("pose", bookcase.pose);
  f.section("shape", bookcase.shape);
  f.section("surface", bookcase.surface);
  f.field("object", bookcase.object);
}

void describe(config::Fields& f, ChairFile& chair) {
  f.require("pose");
  f.field("pose", chair.pose);
  f.section("surface", chair.surface);
  f.field("object", chair.object);
}

void describe(config::Fields& f, CylinderFile& cylinder) {
  f.require("centre");
  f.field("centre", cylinder.centre);
  f.field("radius_m", cylinder.radius_m);
  f.field("z_m", cylinder.z_m);
  f.section("surface", cylinder.surface);
}

void describe(config::Fields& f, PlacedTargetFile& target) {
  f.require("file");
  f.field("file", target.file);
  f.require("pose");
  f.field("pose", target.pose);
}

void describe(config::Fields& f, SolidFile& solid) {
  f.require("shape");
  f.choice("shape", solid.shape, config::choices_of(kSolidKinds));
  f.require("pose");
  f.field("pose", solid.pose);
  f.field("size_m", solid.size_m);
  f.field("elongation", solid.elongation);
  f.field("albedo", solid.albedo);
}

void describe(config::Fields& f, PersonFile& person) {
  f.require("waypoints");
  f.field("waypoints", person.waypoints);
  f.field("speed_m_s", person.speed_m_s);
  f.field("radius_m", person.radius_m);
  f.field("wait_m", person.wait_m);
}

void describe(config::Fields& f, StartFile& start) {
  f.require("pose");
  f.field("pose", start.pose);
}

void describe(config::Fields& f, MovedFile& moved) {
  f.field("share", moved.share);
  f.check("share", moved.share >= 0.0 && moved.share <= 1.0, "must be from 0 to 1");
  f.field("seed", moved.seed);
}

void describe(config::Fields& f, WorldFile& world) {
  f.field("base", world.base);
  f.field("name", world.name);
  f.field("min_corner", world.min_corner);
  f.field("max_corner", world.max_corner);
  f.section("lighting", world.lighting);
  f.section("floor", world.floor);
  f.list("starts", world.starts);
  f.list("walls", world.walls);
  f.list("boxes", world.boxes);
  f.list("tables", world.tables);
  f.list("bookcases", world.bookcases);
  f.list("chairs", world.chairs);
  f.list("cylinders", world.cylinders);
  f.list("targets", world.targets);
  f.list("solids", world.solids);
  f.section("water", world.water);
  f.list("people", world.people);
  f.field("people_walk", world.people_walk);
  f.field("pattern_seed", world.pattern_seed);
  f.section("moved", world.moved);
}

namespace {

/// Adds a wall of one leg, cut at its doors.
Status add_leg(const WallFile& file, const Point2& a, const Point2& b, std::vector<sim::Wall>& walls) {
  const double length_m = (b - a).norm();
  const sim::Wall whole{a, b, file.thickness_m, file.z_min_m, file.z_max_m, file.surface};
  if (file.doors.empty()) {
    walls.push_back(whole);
    return {};
  }
  const auto at = [&](double way_m) { return Point2(a + (b - a) * (way_m / length_m)); };
  std::vector<DoorFile> doors = file.doors;
  std::sort(doors.begin(), doors.end(), [](const DoorFile& x, const DoorFile& y) { return x.at_m < y.at_m; });
  double from_m = 0.0;
  for (const DoorFile& door : doors) {
    const double left_m = door.at_m - door.width_m / 2.0;
    const double right_m = door.at_m + door.width_m / 2.0;
    if (!(left_m > from_m && right_m < length_m)) {
      return fail(Errc::kInvalidArgument, "the door at " + std::to_string(door.at_m) +
                                              " m overlaps another door or the end of its wall; move it");
    }
    sim::Wall piece = whole;
    piece.a = at(from_m);
    piece.b = at(left_m);
    walls.push_back(piece);
    if (door.height_m < file.z_max_m) {
      piece.a = at(left_m);
      piece.b = at(right_m);
      piece.z_min_m = std::max(door.height_m, file.z_min_m);
      walls.push_back(piece);
    }
    from_m = right_m;
  }
  sim::Wall last = whole;
  last.a = at(from_m);
  walls.push_back(last);
  return {};
}

Status add_walls(const WorldFile& file, sim::World& world) {
  for (const WallFile& wall : file.walls) {
    const std::size_t legs = wall.path.size() - (wall.closed ? 0U : 1U);
    for (std::size_t i = 0; i < legs; ++i) {
      if (const Status added = add_leg(wall, wall.path[i], wall.path[(i + 1) % wall.path.size()], world.walls);
          !added) {
        return fail_with_context("world '" + file.name + "'", added.error());
      }
    }
  }
  return {};
}

/// Adds the parts of pieces that consist of several; a piece without a name gets one of its own.
template <class Files, class Make>
void add_pieces(const Files& files, const char* kind, sim::World& world, const Make& make) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string own = std::string(kind) + " " + std::to_string(i);
    const std::vector<sim::Box> parts = make(files[i], files[i].object.empty() ? own : files[i].object);
    world.boxes.insert(world.boxes.end(), parts.begin(), parts.end());
  }
}

void add_furniture(const WorldFile& file, sim::World& world) {
  for (const BoxFile& box : file.boxes) {
    world.boxes.push_back(
        {box.pose, box.size_m.x(), box.size_m.y(), box.z_m.x(), box.z_m.y(), box.surface, box.object});
  }
  add_pieces(file.tables, "table", world, [](const TableFile& t, const std::string& object) {
    return sim::make_table(t.pose, t.shape, t.surface, object);
  });
  add_pieces(file.bookcases, "bookcase", world, [](const BookcaseFile& b, const std::string& object) {
    return sim::make_bookcase(b.pose, b.shape, b.surface, object);
  });
  add_pieces(file.chairs, "chair", world,
             [](const ChairFile& c, const std::string& object) { return sim::make_chair(c.pose, c.surface, object); });
  for (const CylinderFile& c : file.cylinders) {
    world.cylinders.push_back({c.centre, c.radius_m, c.z_m.x(), c.z_m.y(), c.surface});
  }
  for (const SolidFile& solid : file.solids) {
    world.solids.push_back({solid.shape, solid.pose, solid.size_m, solid.elongation, solid.albedo});
  }
  for (const PersonFile& person : file.people) {
    sim::PersonPath path;
    path.waypoints = person.waypoints;
    path.speed_m_s = person.speed_m_s;
    path.radius_m = person.radius_m;
    path.wait_m = person.wait_m;
    world.people.push_back(std::move(path));
  }
}

Result<WorldFile> load_base(const std::filesystem::path& path) {
  const Result<std::string> text = config::read_text_file(path);
  if (!text) {
    return tl::unexpected<Error>(text.error());
  }
  Result<WorldFile> base = parse_world(*text, path.string());
  if (base && !base->base.empty()) {
    return fail(Errc::kInvalidArgument,
                path.string() + ": base: a world that is used as a base cannot have a base itself");
  }
  if (base) {
    for (PlacedTargetFile& target : base->targets) {
      target.file = (path.parent_path() / target.file).string();
    }
  }
  return base;
}

}  // namespace

Result<WorldFile> parse_world(std::string_view text, const std::string& name, WorldFile defaults,
                              const std::vector<std::string>& overrides) {
  const Result<config::Document> document = config::Document::parse(text, name, overrides);
  if (!document) {
    return tl::unexpected<Error>(document.error());
  }
  if (const Status read = document->read(defaults); !read) {
    return tl::unexpected<Error>(read.error());
  }
  return defaults;
}

Result<sim::World> build_world(const WorldFile& file, const TargetLoader& load_target) {
  sim::World world;
  world.name = file.name;
  world.min_corner = file.min_corner;
  world.max_corner = file.max_corner;
  world.lighting = file.lighting;
  world.floor = file.floor;
  world.people_walk = file.people_walk;
  world.pattern_seed = file.pattern_seed;
  world.water = file.water;
  for (const StartFile& start : file.starts) {
    world.starts.push_back(start.pose);
  }
  if (const Status walls = add_walls(file, world); !walls) {
    return tl::unexpected<Error>(walls.error());
  }
  add_furniture(file, world);
  for (const PlacedTargetFile& placed : file.targets) {
    Result<TargetDescription> target = load_target(placed.file);
    if (!target) {
      return fail_with_context("world '" + file.name + "'", target.error());
    }
    const TargetFile& t = target->file;
    world.targets.push_back(
        {t.name, placed.pose, t.width_m, t.depth_m, t.height_m, t.z_min_m, std::move(target->picture)});
  }
  if (const Status valid = sim::validate(world); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  if (file.moved.share > 0.0) {
    Rng rng(file.moved.seed);
    if (const Result<std::size_t> moved = sim::move_objects(world, file.moved.share, rng); !moved) {
      return fail_with_context("world '" + file.name + "': moved", moved.error());
    }
  }
  return world;
}

Result<sim::World> load_world(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  const Result<std::string> text = config::read_text_file(path);
  if (!text) {
    return tl::unexpected<Error>(text.error());
  }
  const std::filesystem::path folder = path.parent_path();
  Result<WorldFile> file = parse_world(*text, path.string(), {}, overrides);
  if (file && !file->base.empty()) {
    Result<WorldFile> base = load_base(folder / file->base);
    if (!base) {
      return fail_with_context(path.string() + ": base", base.error());
    }
    file = parse_world(*text, path.string(), std::move(*base), overrides);
  }
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  if (file->name.empty()) {
    file->name = path.stem().string();
  }
  Result<sim::World> world =
      build_world(*file, [&folder](const std::string& target) { return options::load_target(folder / target); });
  if (!world) {
    return fail_with_context(path.string(), world.error());
  }
  return world;
}

}  // namespace seeker::options
