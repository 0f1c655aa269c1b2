/// \file
/// Selection of loop candidates that agree with each other: pairwise consistency maximisation (Mangelson et al. 2018).
#pragma once

#include <functional>
#include <vector>

#include "common/core/pose2.hpp"

namespace seeker::slam {

/// Odometry between consecutive nodes of one trajectory, which gives the pose of any node in the frame of any other in
/// O(1).
class OdometryChain {
 public:
  /// Takes `previous_T_next` of nodes 0 -> 1, 1 -> 2, ...: there is one node more than steps. Errors of steps are
  /// independent.
  explicit OdometryChain(const std::vector<UncertainPose>& previous_T_next);

  [[nodiscard]] std::size_t size() const { return from_start_.size(); }
  [[nodiscard]] UncertainPose between(std::size_t from, std::size_t to) const;

 private:
  std::vector<UncertainPose> from_start_;
};

/// A loop candidate: node b observed in the frame of node a.
struct LoopEdge {
  std::size_t a = 0;
  std::size_t b = 0;
  UncertainPose a_T_b;
};

struct ConsistencyParams {
  double gate_chi2 = 11.345;  ///< 3 degrees of freedom, 99 % (spec S0.4)
  /// Number of steps of the exact search, beyond which the best set found so far is returned.
  std::size_t max_search = 200'000;
};

struct ConsistentSet {
  std::vector<std::size_t> members;  ///< indices of the candidates, ascending
  /// Candidates that agree with all members but were not observed independently of them.
  std::vector<std::size_t> followers;
  bool exact = true;  ///< false: the search was cut short, a larger set may exist
  /// Size of the largest consistent set of candidates outside `members` that contradict at least one of them: two
  /// contradicting sets of equal size cannot both be true.
  std::size_t rival_size = 0;
};

/// Pose of node `to` in the frame of node `from` by odometry alone.
using RelativePose = std::function<UncertainPose(std::size_t from, std::size_t to)>;

/// Whether two candidates, by their indices, were observed independently of each other. Dependent candidates share the
/// error of one false view, and are never members together.
using Independent = std::function<bool(std::size_t first, std::size_t second)>;

/// The chi2 of the cycle a1 -> b1 -> b2 -> a2 -> a1 against zero.
[[nodiscard]] double cycle_chi2(const LoopEdge& first, const LoopEdge& second, const RelativePose& odometry);

/// The largest set of candidates that all agree with each other: a maximum clique, by branch and bound with greedy
/// colouring (Tomita 2003). Of sets of equal size found, the one with the smallest sum of chi2 is returned. Without
/// `independent` all candidates are independent.
[[nodiscard]] ConsistentSet largest_consistent_set(const std::vector<LoopEdge>& candidates,
                                                   const RelativePose& odometry, const ConsistencyParams& params = {},
                                                   const Independent& independent = {});

}  // namespace seeker::slam
