/// \file
/// The picture that a robot has taken at a node of its topology, as features (spec S4.2: S of T_i), and the comparison
/// of such pictures (spec S4.5).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/core/pose2.hpp"
#include "server/vision/view_features.hpp"

namespace seeker::fleet {

/// Features of a picture and where it was taken. The pose is in the frame of a local map, so that the value stays the
/// same when the map around it moves.
struct NodePicture {
  std::uint32_t node = 0;  ///< id of the local map in which it was taken
  Pose2 node_T_base;       ///< pose of the robot in the frame of that local map
  vision::ViewFeatures features;

  friend bool operator==(const NodePicture&, const NodePicture&) = default;
};

/// Pictures of one robot in the order in which they were taken; none is null.
using NodePictures = std::vector<std::shared_ptr<const NodePicture>>;

/// A picture with the hash of its features.
struct KeyedPicture {
  const NodePicture* picture = nullptr;
  std::uint64_t key = 0;
};
[[nodiscard]] KeyedPicture keyed(const NodePicture& picture);

/// Results of comparisons by the values of both pictures, so that maps which grow compare only what is new.
/// Not thread-safe.
class PictureComparisons {
 public:
  /// As vision::match_views() of their features. The parameters must be the same in all calls.
  [[nodiscard]] std::optional<vision::ViewMatch> match(const KeyedPicture& own, const KeyedPicture& other,
                                                       const vision::ViewMatchParams& params);
  /// Forgets the comparisons of pictures that are not among `own`.
  void keep_only(const NodePictures& own);
  /// Number of comparisons that are known.
  [[nodiscard]] std::size_t size() const { return known_.size(); }

 private:
  /// By the keys of both pictures, the own one first.
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::optional<vision::ViewMatch>> known_;
};

}  // namespace seeker::fleet
