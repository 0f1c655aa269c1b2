/// \file
/// Smoothing over relative poses: keyframes or sub-maps as nodes, odometry and loops as edges that can be undone.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"

namespace seeker::slam {

class BlockSystem;

/// What an edge does to the cost when it disagrees with all others.
enum class EdgeKernel : std::uint8_t {
  kNone,        ///< quadratic: odometry
  kHuber,       ///< linear beyond the width
  kCauchy,      ///< logarithmic beyond the width
  kSwitchable,  ///< switches itself off: dynamic covariance scaling (Agarwal 2013), graduated (Yang 2020)
};

/// A measured pose of node j in the frame of node i.
struct PoseEdge {
  std::size_t i = 0;
  std::size_t j = 0;
  Pose2 i_T_j;
  Matrix3 information = Matrix3::Identity();  ///< inverse covariance of (x, y, theta) of i_T_j in the frame i
  EdgeKernel kernel = EdgeKernel::kNone;
  double kernel_width = 3.0;  ///< deviations (root of chi2) up to which the edge counts in full
};

struct PoseGraphParams {
  double stop_m = 1e-5;  ///< converged when no node moves more than this
  double stop_rad = 1e-6;
  double first_damping = 1e-9;  ///< of Levenberg-Marquardt, relative to the diagonal
  double max_damping = 1e3;
  /// Switchable edges begin with a width that trusts all of them and shrinks to theirs: a true loop that closes a
  /// large drift is not mistaken for an outlier. The factor per iteration is at least this.
  double graduation = 1.6;
  double switched_off_weight = 0.25;  ///< a switchable edge with less weight counts as switched off
};

struct OptimiseReport {
  double initial_chi2 = 0.0;  ///< robust cost with the edges' own kernel widths
  double final_chi2 = 0.0;
  int iterations = 0;
  bool converged = false;
  std::size_t switched_off = 0;  ///< enabled edges that disagree with all others
};

/// Nodes and edges are numbered in the order they were added and keep their numbers until drop_nodes(). Residual of an
/// edge: components of inverse(map_T_i) * map_T_j minus i_T_j, angle wrapped (spec S0.3). A copy is a snapshot to go
/// back to.
class PoseGraph {
 public:
  explicit PoseGraph(const PoseGraphParams& params = {});
  PoseGraph(const PoseGraph& other);
  PoseGraph(PoseGraph&& other) noexcept;
  PoseGraph& operator=(const PoseGraph& other);
  PoseGraph& operator=(PoseGraph&& other) noexcept;
  ~PoseGraph();

  /// The first node is the fixed one until fix() names another.
  std::size_t add_node(const Pose2& map_T_node);
  void fix(std::size_t node);
  /// This one is fixed, too, for good. Edges between fixed nodes have no say and cost nothing.
  void hold(std::size_t node);
  void set_pose(std::size_t node, const Pose2& map_T_node);
  [[nodiscard]] const Pose2& pose(std::size_t node) const { return nodes_.at(node); }
  [[nodiscard]] std::size_t node_count() const { return nodes_.size(); }

  /// The edge's number. kInvalidArgument: a node that does not exist or is its own partner, a pose that is not finite,
  /// an information matrix that is not symmetric and positive semi-definite, a kernel without width.
  [[nodiscard]] Result<std::size_t> add_edge(const PoseEdge& edge);
  /// A disabled edge has no say until it is enabled again: the undo of a loop. Costs nothing at the next optimise().
  void set_enabled(std::size_t edge, bool enabled);
  /// Disables it for good and lets the matrix forget its place.
  void remove_edge(std::size_t edge);
  /// Takes out the nodes from `first` to before `end` and the edges at them; not the one that fix() names. The nodes
  /// after them and all edges are numbered anew without gaps, in the same order; removed edges are gone.
  void drop_nodes(std::size_t first, std::size_t end);
  [[nodiscard]] bool enabled(std::size_t edge) const { return edges_.at(edge).state == State::kEnabled; }
  [[nodiscard]] const PoseEdge& edge(std::size_t edge) const { return edges_.at(edge).edge; }
  [[nodiscard]] std::size_t edge_count() const { return edges_.size(); }

  /// Squared residual over covariance at the present poses, no kernel; 3 degrees of freedom.
  [[nodiscard]] double edge_chi2(std::size_t edge) const;
  /// Share of its information that the edge's kernel leaves it at the present poses: 0 to 1; 0 when disabled.
  [[nodiscard]] double edge_weight(std::size_t edge) const;

  /// Levenberg-Marquardt from the present poses; the sparsity pattern is analysed only after it changed. Poses are
  /// left as they were on failure. kNotReady: no node, or nodes without a path of enabled edges to a fixed one.
  /// kInternal: the matrix has no solution (edges without information).
  [[nodiscard]] Result<OptimiseReport> optimise(int max_iterations = 20);

  /// Covariance of (x, y, theta) of the pose of `node` in the frame of `base`, at the present poses and the kernels'
  /// weights. Errors as optimise().
  [[nodiscard]] Result<Matrix3> relative_covariance(std::size_t base, std::size_t node);

 private:
  enum class State : std::uint8_t { kEnabled, kDisabled, kRemoved };
  struct Entry {
    PoseEdge edge;
    State state = State::kEnabled;
    std::size_t slot = 0;  ///< its place in the matrix
  };

  enum class Step : std::uint8_t { kDone, kSmall, kImpossible };

  [[nodiscard]] bool is_fixed(std::size_t node) const { return node == fixed_ || held_[node]; }
  /// Whether it can move anything.
  [[nodiscard]] bool has_say(const Entry& entry) const {
    return entry.state == State::kEnabled && !(is_fixed(entry.edge.i) && is_fixed(entry.edge.j));
  }
  [[nodiscard]] Status prepare();
  [[nodiscard]] Status check_connected() const;
  void analyse();
  /// Robust cost; switchable kernels are `widening` times as wide in chi2.
  [[nodiscard]] double cost(double widening) const;
  [[nodiscard]] double first_widening() const;
  void linearise(double widening);
  [[nodiscard]] bool move_nodes(double& largest_m, double& largest_rad);
  [[nodiscard]] Step step(double& damping, double widening);

  PoseGraphParams params_;
  std::vector<Pose2> nodes_;
  std::vector<bool> held_;              ///< by node
  std::vector<std::size_t> variables_;  ///< by node: its place in the system, of those that move; since analysed
  std::size_t variable_count_ = 0;
  std::vector<Entry> edges_;
  std::size_t fixed_ = 0;
  std::unique_ptr<BlockSystem> system_;  ///< absent until analysed
  bool connected_ = false;               ///< known to be since the last change
  bool factored_ = false;                ///< system_ holds the undamped matrix of the present poses
};

}  // namespace seeker::slam
