#include "server/sim/furniture.hpp"

#include <array>

#include "common/core/rng.hpp"

namespace seeker::sim {
namespace {

constexpr double kBoard_m = 0.03;

constexpr std::array<std::array<double, 2>, 4> kCorners{{{1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

/// A box of a piece that stands at `world_T_piece`, (dx, dy) from its middle.
Box part(const Pose2& world_T_piece, const Point2& offset, const Point2& size, const Point2& z, const Surface& surface,
         const std::string& object) {
  return {world_T_piece * Pose2{offset.x(), offset.y(), 0.0}, size.x(), size.y(), z.x(), z.y(), surface, object};
}

/// Books of one shelf, whose board ends at z_m.
void add_books(const Pose2& world_T_case, const BookcaseShape& shape, double z_m, const std::string& object, Rng& rng,
               std::vector<Box>& boxes) {
  constexpr double kGap_m = 0.006;
  const double end_m = shape.length_m / 2.0 - kBoard_m;
  double at_m = -end_m;
  while (true) {
    const double width_m = rng.uniform(0.03, 0.22);
    const bool empty = rng.uniform() < shape.empty_share;
    if (at_m + width_m > end_m) {
      return;
    }
    if (!empty) {
      const double height_m = shape.shelf_m * rng.uniform(0.5, 0.85);
      const double depth_m = shape.depth_m * rng.uniform(0.45, 0.8);
      const double print = rng.uniform();  // most spines are plain
      const Surface surface{rng.uniform(0.15, 0.85), 0.8 * print * print * print * print, rng.uniform(0.03, 0.1),
                            static_cast<std::uint32_t>(rng.bits() & 0xffffffffU)};
      boxes.push_back(part(world_T_case, {at_m + width_m / 2.0, rng.uniform(-0.1, 0.1) * shape.depth_m},
                           {width_m - kGap_m, depth_m}, {z_m, z_m + height_m}, surface, object));
    }
    at_m += width_m;
  }
}

}  // namespace

std::vector<Box> make_table(const Pose2& world_T_table, const TableShape& shape, const Surface& surface,
                            const std::string& object) {
  std::vector<Box> boxes;
  const double z_top = shape.height_m - shape.thickness_m;
  boxes.push_back({world_T_table, shape.length_m, shape.width_m, z_top, shape.height_m, surface, object});
  const double dx = (shape.length_m - shape.leg_m) / 2.0;
  const double dy = (shape.width_m - shape.leg_m) / 2.0;
  for (const auto& [sx, sy] : kCorners) {
    boxes.push_back(part(world_T_table, {sx * dx, sy * dy}, {shape.leg_m, shape.leg_m}, {0.0, z_top}, surface, object));
  }
  return boxes;
}

std::vector<Box> make_bookcase(const Pose2& world_T_case, const BookcaseShape& shape, const Surface& surface,
                               const std::string& object) {
  constexpr double kBack_m = 0.01;
  std::vector<Box> boxes;
  Rng rng(surface.pattern);
  const double top_m = shape.shelves * shape.shelf_m + kBoard_m;
  boxes.push_back(part(world_T_case, {0.0, (kBack_m - shape.depth_m) / 2.0}, {shape.length_m, kBack_m}, {0.0, top_m},
                       surface, object));
  for (const double side : {-1.0, 1.0}) {
    boxes.push_back(part(world_T_case, {side * (shape.length_m - kBoard_m) / 2.0, 0.0}, {kBoard_m, shape.depth_m},
                         {0.0, top_m}, surface, object));
  }
  for (int k = 0; k <= shape.shelves; ++k) {
    const double z_m = k * shape.shelf_m;
    boxes.push_back(part(world_T_case, Point2::Zero(), {shape.length_m - 2.0 * kBoard_m, shape.depth_m},
                         {z_m, z_m + kBoard_m}, surface, object));
    if (k < shape.shelves) {
      add_books(world_T_case, shape, z_m + kBoard_m, object, rng, boxes);
    }
  }
  return boxes;
}

std::vector<Box> make_chair(const Pose2& world_T_chair, const Surface& surface, const std::string& object) {
  constexpr double kSide_m = 0.42;
  constexpr double kSeat_m = 0.45;
  constexpr double kBack_m = 0.92;
  constexpr double kBackLow_m = 0.56;
  const double out_m = (kSide_m - kBoard_m) / 2.0;
  std::vector<Box> boxes;
  boxes.push_back(
      part(world_T_chair, Point2::Zero(), {kSide_m, kSide_m}, {kSeat_m - kBoard_m, kSeat_m}, surface, object));
  boxes.push_back(part(world_T_chair, {-out_m, 0.0}, {kBoard_m, kSide_m}, {kBackLow_m, kBack_m}, surface, object));
  for (const auto& [sx, sy] : kCorners) {
    boxes.push_back(part(world_T_chair, {sx * out_m, sy * out_m}, {kBoard_m, kBoard_m},
                         {0.0, sx > 0.0 ? kSeat_m - kBoard_m : kBackLow_m}, surface, object));
  }
  return boxes;
}

}  // namespace seeker::sim
