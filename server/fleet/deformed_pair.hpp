/// \file
/// Two maps joined by node pairs as one graph, in which both deform within their covariances.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/fleet/map_graph.hpp"
#include "server/fleet/pair_check.hpp"

namespace seeker::fleet {

struct DeformationParams {
  std::size_t min_pairs = 2;  ///< number of agreeing pairs from which on maps are deformed before they are judged
  /// Largest chi2 per degree of freedom of the deformation, three standard deviations on average: beyond it the maps
  /// would have to deform more than they can.
  double max_ratio = 9.0;
  double kernel_width = 3.0;  ///< residual, in standard deviations, beyond which a pair loses its weight
  int max_iterations = 50;
  /// A local map whose pose in the other map is less certain than this after the deformation proves and denies nothing.
  double max_sigma_m = 0.3;
  double max_sigma_rad = 0.05;
};

/// How far two maps had to deform to satisfy their pairs, against what their covariances allow.
struct Deformation {
  double chi2 = 0.0;             ///< squared residuals over covariances that the pairs add to both maps
  std::size_t dof = 0;           ///< 3 for each pair after the first; 0: the maps were not deformed
  double largest_m = 0.0;        ///< largest displacement between two neighbouring local maps of one robot
  double largest_rad = 0.0;      ///< largest rotation between two neighbouring local maps of one robot
  std::size_t switched_off = 0;  ///< number of pairs that the others contradict

  /// About 1 where the pairs are right; 0 without redundancy.
  [[nodiscard]] double ratio() const { return dof == 0 ? 0.0 : chi2 / static_cast<double>(dof); }
};

class DeformedPair {
 public:
  /// Joins both maps by the pairs and optimises; the frame of the result is that of map a at its first local map.
  /// `a_T_b` is where map b stands to begin with. Their covariances are multiplied by the variance_factor() of both.
  /// Errors are those of slam::PoseGraph.
  [[nodiscard]] static Result<DeformedPair> make(const LineMap& a, const LineMap& b,
                                                 const std::vector<NodeRelation>& pairs, const Pose2& a_T_b,
                                                 const DeformationParams& params = {});

  [[nodiscard]] const Deformation& deformation() const { return deformation_; }
  [[nodiscard]] const Pose2& pose_a(std::uint32_t id) const { return graph_.pose(nodes_a_.at(id)); }
  [[nodiscard]] const Pose2& pose_b(std::uint32_t id) const { return graph_.pose(nodes_b_.at(id)); }
  /// Whether the pose of a local map of b in the nearest one of a is known as exactly as DeformationParams asks.
  [[nodiscard]] bool certain(std::uint32_t id_a, std::uint32_t id_b);
  /// Whether the others leave the pair its weight, by its index.
  [[nodiscard]] bool in_force(std::size_t pair) const;

 private:
  DeformedPair() = default;
  void measure(const LineMap& map, const GraphNodes& nodes);

  DeformationParams params_;
  slam::PoseGraph graph_;
  GraphNodes nodes_a_;
  GraphNodes nodes_b_;
  std::vector<std::size_t> pair_edges_;
  Deformation deformation_;
};

}  // namespace seeker::fleet
