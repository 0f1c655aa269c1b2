/// \file
/// Pictures of robots that drive through a world of line segments: marks on the walls, each with a look of its own.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "server/fleet/node_picture.hpp"
#include "tests/unit/server/fleet/toy_maps.hpp"

namespace seeker::fleet {

struct ToyMark {
  Point2 p_world = Point2::Zero();
  vision::Descriptor look{};
};

/// Marks along all walls; another seed, another wallpaper.
inline std::vector<ToyMark> marks_on(const std::vector<Wall>& walls, std::uint64_t seed, double spacing_m = 0.12) {
  Rng rng(seed);
  std::vector<ToyMark> marks;
  for (const Wall& wall : walls) {
    const int count = static_cast<int>((wall.second - wall.first).norm() / spacing_m);
    for (int k = 0; k < count; ++k) {
      ToyMark& mark = marks.emplace_back();
      mark.p_world = wall.first + (wall.second - wall.first) * ((k + 0.5) / count);
      for (std::uint8_t& byte : mark.look) {
        byte = static_cast<std::uint8_t>(rng.uniform(0.0, 120.0));
      }
    }
  }
  return marks;
}

/// The marks within 3 m, all around; walls hide none.
inline vision::ViewFeatures view_from(const std::vector<ToyMark>& marks, const Pose2& world_T_base) {
  constexpr double kRange_m = 3.0;
  vision::ViewFeatures features;
  for (const ToyMark& mark : marks) {
    const Point2 p = inverse(world_T_base) * mark.p_world;
    if (p.norm() <= kRange_m) {
      features.bearings_rad.push_back(static_cast<float>(std::atan2(p.y(), p.x())));
      features.descriptors.push_back(mark.look);
    }
  }
  return features;
}

/// Pictures at every fifth of the poses of which the map was made.
inline NodePictures toy_pictures(const LineMap& map, const std::vector<Pose2>& world_T_base,
                                 const std::vector<ToyMark>& marks) {
  constexpr std::size_t kEvery = 5;
  NodePictures pictures;
  for (std::size_t k = 0; k < world_T_base.size(); k += kEvery) {
    pictures.push_back(std::make_shared<const NodePicture>(
        NodePicture{map.keyframes[k].node, map.keyframes[k].node_T_base, view_from(marks, world_T_base[k])}));
  }
  return pictures;
}

}  // namespace seeker::fleet
