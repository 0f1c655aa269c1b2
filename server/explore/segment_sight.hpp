/// \file
/// Prediction of what would be observed of a mapped building from a place: walls, and how far those that continue would
/// grow (spec S1.11).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/line_map.hpp"
#include "server/explore/one_step_params.hpp"
#include "server/nav/cost_map.hpp"

namespace seeker::explore {

/// A mapped wall as seen from its free side: frame and ends as in MapSegment.
struct SightWall {
  Pose2 map_T_segment;
  double length_m = 0.0;
  std::array<bool, 2> real{};  ///< by lines::Side
};

/// A virtual end, beyond which the wall may continue.
struct OpenEnd {
  std::size_t wall = 0;  ///< index into SightScene::walls()
  std::size_t side = 0;  ///< lines::Side
  /// Distance beyond the end at which the half-line stops from every viewpoint: at a wall, or at floor observed to be
  /// free.
  double stop_m = 0.0;
  bool corner = false;  ///< whether another wall stops it, so that a real end is expected there
};

/// The part of a wall that would be observed; x runs along the wall's own axis.
struct SeenPart {
  double from_m = 0.0;
  double to_m = 0.0;
  int beams = 0;
  std::array<bool, 2> ends{};  ///< by lines::Side: whether the end itself is in view
};

struct EndForecast {
  std::size_t end = 0;       ///< index into SightScene::open_ends()
  double extension_m = 0.0;  ///< length by which the wall would grow there
  bool becomes_real = false;
};

/// V and N of spec S1.11 for one pose.
struct Growth {
  double extension_m = 0.0;  ///< sum of V-
  double new_ends = 0.0;     ///< sum of N- minus sum of N; an integer, unless discounted by a planner
  std::vector<EndForecast> ends;
};

class SightView;

/// The walls around a place with everything that does not depend on the exact viewpoint. The cost is linear in the
/// map's segments and quadratic (with a small factor) in those within reach.
class SightScene {
 public:
  /// Takes the walls within `reach_m` of `place_map` (frame `map`). `floor` is null or the known floor: walls do not
  /// continue where the floor was observed to be free, and obstacles that are no walls hide what is behind them. This
  /// goes beyond the paper, which uses segments only.
  SightScene(const std::vector<MapSegment>& segments, const Point2& place_map, double reach_m,
             const OneStepParams& params, const Grid<nav::CellState>* floor = nullptr);

  [[nodiscard]] const std::vector<SightWall>& walls() const { return walls_; }
  [[nodiscard]] const std::vector<OpenEnd>& open_ends() const { return ends_; }
  /// Number of all segments of the map, also of those out of reach.
  [[nodiscard]] std::size_t map_segments() const { return map_segments_; }
  /// Sum of their lengths.
  [[nodiscard]] double map_length_m() const { return map_length_m_; }
  /// What is observed from a pose; valid as long as the scene. The pose must be near enough to the scene's place for
  /// the reach to cover its view.
  [[nodiscard]] SightView look(const Pose2& map_T_base) const;

 private:
  friend class SightView;

  /// The crossing of the half-lines beyond two ends.
  struct Meeting {
    std::array<std::size_t, 2> ends{};
    std::array<double, 2> at_m{};
  };

  void find_stop(OpenEnd& end) const;
  void stop_at_wall(OpenEnd& end, const SightWall& other) const;
  void stop_at_seen_floor(OpenEnd& end) const;
  void find_meetings();

  SensorModel sensor_;
  double corner_gap_m_;
  const Grid<nav::CellState>* floor_;
  std::size_t map_segments_ = 0;
  double map_length_m_ = 0.0;
  std::vector<SightWall> walls_;
  std::vector<OpenEnd> ends_;
  std::vector<Meeting> meetings_;  ///< nearest first
};

/// One view: the distance to the first obstacle in every direction.
class SightView {
 public:
  /// The part of a wall that is observed. The wall need not belong to the scene: the estimate of a filter may be used.
  /// Nothing: it is out of range, hidden, seen from behind or at too flat an angle.
  [[nodiscard]] std::optional<SeenPart> part_of(const SightWall& wall) const;
  [[nodiscard]] Growth growth() const;
  [[nodiscard]] const Pose2& map_T_base() const { return map_T_base_; }

 private:
  friend class SightScene;

  /// The robot's pose in the frame of a wall.
  struct Place {
    double x_m = 0.0;
    double ahead_m = 0.0;  ///< distance to the wall's line; negative: behind it
    double heading_rad = 0.0;
  };

  SightView(const SightScene& scene, const Pose2& map_T_base);
  void add_wall(const SightWall& wall);
  void add_floor();
  [[nodiscard]] Place place_at(const SightWall& wall) const;
  /// Calls visit(beam) for the beams whose angle to the base lies in [from_rad, from_rad + span_rad].
  template <class Visit>
  void for_beams(double from_rad, double span_rad, const Visit& visit) const;
  [[nodiscard]] bool sees(const Place& place, double x_m) const;
  [[nodiscard]] bool hidden(std::size_t beam, double range_m, double sine) const;
  [[nodiscard]] std::optional<double> extension_m(const OpenEnd& end) const;

  const SightScene* scene_;
  Pose2 map_T_base_;
  std::vector<double> depth_m_;  ///< by beam; infinity: no obstacle
};

}  // namespace seeker::explore
