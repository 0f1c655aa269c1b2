/// \file
/// Pose graph optimisation: keyframes or local maps as nodes, odometry and loops as edges that can be disabled.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"

namespace seeker::slam {

class BlockSystem;

/// Robust cost of an edge that disagrees with all others.
enum class EdgeKernel : std::uint8_t {
  kNone,        ///< quadratic: odometry
  kHuber,       ///< linear beyond the width
  kCauchy,      ///< logarithmic beyond the width
  kSwitchable,  ///< disabled by dynamic covariance scaling (Agarwal 2013), graduated (Yang 2020)
};

/// A measured pose of node j in the frame of node i.
struct PoseEdge {
  std::size_t i = 0;
  std::size_t j = 0;
  Pose2 i_T_j;
  Matrix3 information = Matrix3::Identity();  ///< inverse covariance of (x, y, theta) of i_T_j in the frame i
  EdgeKernel kernel = EdgeKernel::kNone;
  /// Residual, in standard deviations (root of chi2), up to which the edge has its full weight.
  double kernel_width = 3.0;
};

struct PoseGraphParams {
  double stop_m = 1e-5;  ///< converged when no node moves more than this
  double stop_rad = 1e-6;
  double first_damping = 1e-9;  ///< of Levenberg-Marquardt, relative to the diagonal
  double max_damping = 1e3;
  /// Switchable edges begin with a kernel width that accepts all of them and that shrinks to their own: a true loop
  /// that closes a large drift is not mistaken for an outlier. The factor per iteration is at least this.
  double graduation = 1.6;
  double switched_off_weight = 0.25;  ///< a switchable edge with less weight counts as disabled
};

struct OptimiseReport {
  double initial_chi2 = 0.0;  ///< robust cost with the edges' own kernel widths
  double final_chi2 = 0.0;
  int iterations = 0;
  bool converged = false;
  std::size_t switched_off = 0;  ///< enabled edges that disagree with all others
};

/// Nodes and edges are numbered in the order they were added and keep their numbers until drop_nodes(). The residual of
/// an edge consists of the components of inverse(map_T_i) * map_T_j minus i_T_j, with the angle wrapped (spec S0.3). A
/// copy of the graph serves as a snapshot.
class PoseGraph {
 public:
  explicit PoseGraph(const PoseGraphParams& params = {});
  PoseGraph(const PoseGraph& other);
  PoseGraph(PoseGraph&& other) noexcept;
  PoseGraph& operator=(const PoseGraph& other);
  PoseGraph& operator=(PoseGraph&& other) noexcept;
  ~PoseGraph();

  /// Adds a node. The first node is the fixed one until fix() names another.
  std::size_t add_node(const Pose2& map_T_node);
  void fix(std::size_t node);
  /// Fixes this node, too, permanently. Edges between fixed nodes have no effect and cost nothing.
  void hold(std::size_t node);
  void set_pose(std::size_t node, const Pose2& map_T_node);
  [[nodiscard]] const Pose2& pose(std::size_t node) const { return nodes_.at(node); }
  [[nodiscard]] std::size_t node_count() const { return nodes_.size(); }

  /// Adds an edge and returns its number. Fails with kInvalidArgument for a node that does not exist or is its own
  /// partner, a pose that is not finite, an information matrix that is not symmetric and positive semi-definite, or a
  /// kernel without width.
  [[nodiscard]] Result<std::size_t> add_edge(const PoseEdge& edge);
  /// A disabled edge has no effect until it is enabled again: the undo of a loop. This costs nothing at the next
  /// optimise().
  void set_enabled(std::size_t edge, bool enabled);
  /// Disables the edge permanently and removes its block from the matrix.
  void remove_edge(std::size_t edge);
  /// Removes the nodes from `first` to before `end` and the edges at them; the node that fix() names may not be among
  /// them. The following nodes and all edges are renumbered without gaps, in the same order; removed edges are gone.
  void drop_nodes(std::size_t first, std::size_t end);
  [[nodiscard]] bool enabled(std::size_t edge) const { return edges_.at(edge).state == State::kEnabled; }
  [[nodiscard]] const PoseEdge& edge(std::size_t edge) const { return edges_.at(edge).edge; }
  [[nodiscard]] std::size_t edge_count() const { return edges_.size(); }

  /// Squared residual over covariance at the present poses, without the kernel; 3 degrees of freedom.
  [[nodiscard]] double edge_chi2(std::size_t edge) const;
  /// Weight (0 to 1) that the edge's kernel leaves it at the present poses; 0 when disabled.
  [[nodiscard]] double edge_weight(std::size_t edge) const;

  /// Levenberg-Marquardt from the present poses; the sparsity pattern is analysed only after it changed. Poses are left
  /// as they were on failure. Fails with kNotReady without a node, or when nodes have no path of enabled edges to a
  /// fixed one, and with kInternal when the matrix has no solution (edges without information).
  [[nodiscard]] Result<OptimiseReport> optimise(int max_iterations = 20);

  /// Covariance of (x, y, theta) of the pose of `node` in the frame of `base`, at the present poses and the kernels'
  /// weights. Errors are those of optimise().
  [[nodiscard]] Result<Matrix3> relative_covariance(std::size_t base, std::size_t node);

 private:
  enum class State : std::uint8_t { kEnabled, kDisabled, kRemoved };
  struct Entry {
    PoseEdge edge;
    State state = State::kEnabled;
    std::size_t slot = 0;  ///< index of its block in the matrix
  };

  enum class Step : std::uint8_t { kDone, kSmall, kImpossible };

  [[nodiscard]] bool is_fixed(std::size_t node) const { return node == fixed_ || held_[node]; }
  /// Whether the edge affects any pose.
  [[nodiscard]] bool has_say(const Entry& entry) const {
    return entry.state == State::kEnabled && !(is_fixed(entry.edge.i) && is_fixed(entry.edge.j));
  }
  [[nodiscard]] Status prepare();
  [[nodiscard]] Status check_connected() const;
  void analyse();
  /// The robust cost; switchable kernels are `widening` times as wide in chi2.
  [[nodiscard]] double cost(double widening) const;
  [[nodiscard]] double first_widening() const;
  void linearise(double widening);
  [[nodiscard]] bool move_nodes(double& largest_m, double& largest_rad);
  [[nodiscard]] Step step(double& damping, double widening);

  PoseGraphParams params_;
  std::vector<Pose2> nodes_;
  std::vector<bool> held_;  ///< by node
  /// By node: its index in the system, of those that move, since the last analysis.
  std::vector<std::size_t> variables_;
  std::size_t variable_count_ = 0;
  std::vector<Entry> edges_;
  std::size_t fixed_ = 0;
  std::unique_ptr<BlockSystem> system_;  ///< absent until analysed
  bool connected_ = false;               ///< connectivity has been checked since the last change
  bool factored_ = false;                ///< system_ holds the undamped matrix of the present poses
};

}  // namespace seeker::slam
