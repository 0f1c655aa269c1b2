/// \file
/// Nodes of two robots whose pictures are similar (spec S4.5): they propose where one map lies in the other, and say
/// for a hypothesis whether both robots have seen the same where it lays them upon each other.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "server/fleet/prepared_map.hpp"

namespace seeker::fleet {

struct PictureParams {
  vision::ViewMatchParams views;
  /// Number of the most similar pictures of the other map that are tried for one picture: where ICP and eq (7) refuse
  /// one, the next one is tried (feedback, spec S4.7).
  std::size_t tries = 4;
  std::size_t max_checks = 24;  ///< number of proposals that are checked in one comparison of two maps
  double scans_m = 2.5;         ///< scans made within this distance of a picture are matched with the other map
  double alike_m = 2.0;         ///< largest distance of two places whose pictures are similar
  double alike_rad = 0.35;      ///< largest error of the rotation that similar pictures say
  double near_m = 0.7;          ///< pictures taken within this distance should be similar
  /// Number of places of either robot whose pictures are similar from which on a hypothesis counts as confirmed by
  /// pictures.
  std::size_t sure_alike = 2;
  /// Number of places of either robot near each other, all with different pictures, from which on a hypothesis counts
  /// as denied by pictures.
  std::size_t sure_unlike = 2;
  /// Pictures with fewer features, or of which less than this share looks at the directions that the other one shows,
  /// deny nothing: of a bare wall, or of another side of the place.
  std::size_t min_features = 60;
  double min_directions = 0.5;

  friend bool operator==(const PictureParams&, const PictureParams&) = default;
};

/// A picture with its pose in the map as it is now.
struct PlacedPicture : KeyedPicture {
  std::size_t node = 0;  ///< index of its local map among the prepared ones
  Pose2 map_T_base;
};
/// The pictures of the local maps that are there.
[[nodiscard]] std::vector<PlacedPicture> placed_pictures(const PreparedMap& map);

/// The region of the map that shows where a picture was taken; else that of its local map.
[[nodiscard]] std::size_t region_of(const PreparedMap& map, const PlacedPicture& picture);

/// Two similar pictures.
struct PicturePair {
  PlacedPicture a;
  PlacedPicture b;
  vision::ViewMatch match;

  /// The pose of robot b's base in the frame `map` of robot a as the pictures say: at the place where a's was taken,
  /// with the rotation that the matches agree on (spec S4.6).
  [[nodiscard]] Pose2 map_a_T_base_b() const;
};

/// What pictures say of a hypothesis, by numbers of places of the robot that has fewer.
struct PictureEvidence {
  std::size_t alike = 0;   ///< places with a similar picture of the other robot where the hypothesis expects one
  std::size_t unlike = 0;  ///< places near one of the other robot without any similar picture there

  [[nodiscard]] bool confirms(const PictureParams& params) const { return alike >= params.sure_alike; }
  [[nodiscard]] bool denies(const PictureParams& params) const { return alike == 0 && unlike >= params.sure_unlike; }
};

/// All similar pictures of two maps, which must outlive it and must not change.
class PicturePairs {
 public:
  PicturePairs(PreparedMap& a, PreparedMap& b, const PictureParams& params);

  /// By pictures of b in the order in which they were taken, the most similar ones of a first, at most
  /// PictureParams::tries for each.
  [[nodiscard]] std::vector<PicturePair> proposals() const;
  /// Whether two pictures would be similar if they were of one place: both show enough, in the same directions.
  /// `expected` is the pose of robot b in the frame `map` of robot a that is to be judged.
  [[nodiscard]] bool comparable(const PlacedPicture& of_a, const PlacedPicture& of_b, const Pose2& expected) const;
  /// Whether a pair lies where a pose of map b in map a expects it. `map_a_T_node` gives the pose of a local map of b,
  /// by index, in the frame `map` of a.
  [[nodiscard]] bool agrees(const PicturePair& pair, const std::function<Pose2(std::size_t)>& map_a_T_node) const;
  [[nodiscard]] PictureEvidence evidence(const std::function<Pose2(std::size_t)>& map_a_T_node) const;

 private:
  const PictureParams& params_;
  std::vector<PlacedPicture> pictures_a_;
  std::vector<PlacedPicture> pictures_b_;
  std::vector<PicturePair> pairs_;  ///< by pictures of b, the most similar first
};

}  // namespace seeker::fleet
