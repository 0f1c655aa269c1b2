/// \file
/// Worlds for closed-loop tests of exploration.
#pragma once

#include "tests/unit/server/explore/toy_explorer.hpp"

namespace seeker::explore {

/// Two rooms of 5 x 5 m joined by a door of 1.2 m.
inline ToyWorld two_rooms() {
  ToyWorld world;
  world.walls = joined(box(0, 0, 10.2, 5), {{{5.1, 0.0}, {5.1, 1.9}}, {{5.1, 3.1}, {5.1, 5.0}}});
  return world;
}

/// A corridor of 18 x 2 m with three rooms of 6 x 4 m on each side, their doors of 1.0 m off the middle, and a desk in
/// every second room.
inline ToyWorld office() {
  ToyWorld world;
  world.walls = box(0, 0, 18, 10);
  for (int room = 0; room < 3; ++room) {
    const double x = 6.0 * room;
    const double door = x + (room == 1 ? 1.0 : 4.0);
    for (const double y : {4.0, 6.0}) {
      world.walls.push_back({{x, y}, {door, y}});
      world.walls.push_back({{door + 1.0, y}, {x + 6.0, y}});
    }
    if (room > 0) {
      world.walls.push_back({{x, 0.0}, {x, 4.0}});
      world.walls.push_back({{x, 6.0}, {x, 10.0}});
    }
    const double desk_y = room == 1 ? 8.0 : 1.2;
    world.walls = joined(std::move(world.walls), box(x + 2.0, desk_y, x + 3.4, desk_y + 0.7));
  }
  return world;
}

/// A ring of corridors 1.8 m wide about a core of 8 x 6 m, with four alcoves.
inline ToyWorld ring() {
  ToyWorld world;
  world.walls = joined(box(1.8, 1.8, 9.8, 7.8), {{{0.0, 0.0}, {5.0, 0.0}},
                                                 {{5.0, 0.0}, {5.0, -1.5}},
                                                 {{5.0, -1.5}, {7.0, -1.5}},
                                                 {{7.0, -1.5}, {7.0, 0.0}},
                                                 {{7.0, 0.0}, {11.6, 0.0}},
                                                 {{11.6, 0.0}, {11.6, 4.0}},
                                                 {{11.6, 4.0}, {13.4, 4.0}},
                                                 {{13.4, 4.0}, {13.4, 6.0}},
                                                 {{13.4, 6.0}, {11.6, 6.0}},
                                                 {{11.6, 6.0}, {11.6, 9.6}},
                                                 {{11.6, 9.6}, {3.0, 9.6}},
                                                 {{3.0, 9.6}, {3.0, 11.4}},
                                                 {{3.0, 11.4}, {1.2, 11.4}},
                                                 {{1.2, 11.4}, {1.2, 9.6}},
                                                 {{1.2, 9.6}, {0.0, 9.6}},
                                                 {{0.0, 9.6}, {0.0, 0.0}}});
  return world;
}

}  // namespace seeker::explore
