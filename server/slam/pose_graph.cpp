#include "server/slam/pose_graph.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Eigenvalues>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "server/slam/block_system.hpp"

namespace seeker::slam {
namespace {

/// Residual of an edge and its derivatives by the poses of i and j.
struct Residual {
  Eigen::Vector3d value;
  Matrix3 by_i;
  Matrix3 by_j;
};

/// d(inverse(i) * j)/di and /dj: the chain rule on spec S0.3 written out.
Residual linearised(const Pose2& map_T_i, const Pose2& map_T_j, const Pose2& i_T_j) {
  const double c = std::cos(map_T_i.theta_rad);
  const double s = std::sin(map_T_i.theta_rad);
  const double dx = map_T_j.x_m - map_T_i.x_m;
  const double dy = map_T_j.y_m - map_T_i.y_m;
  const double x = c * dx + s * dy;
  const double y = c * dy - s * dx;
  Residual r;
  r.value = {x - i_T_j.x_m, y - i_T_j.y_m, wrap_angle(map_T_j.theta_rad - map_T_i.theta_rad - i_T_j.theta_rad)};
  r.by_i << -c, -s, y, s, -c, -x, 0.0, 0.0, -1.0;
  r.by_j << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
  return r;
}

/// Cost and its derivative by chi2, for a kernel of squared width `width2`.
struct Robust {
  double cost;
  double weight;
};

Robust robust(EdgeKernel kernel, double chi2, double width2) {
  const bool within = chi2 <= width2;
  switch (kernel) {
    case EdgeKernel::kHuber:
      return within ? Robust{chi2, 1.0} : Robust{2.0 * std::sqrt(width2 * chi2) - width2, std::sqrt(width2 / chi2)};
    case EdgeKernel::kCauchy: return {width2 * std::log1p(chi2 / width2), 1.0 / (1.0 + chi2 / width2)};
    case EdgeKernel::kSwitchable: {
      const double scale = 2.0 * width2 / (width2 + chi2);
      return within ? Robust{chi2, 1.0} : Robust{width2 * (3.0 * chi2 - width2) / (chi2 + width2), scale * scale};
    }
    case EdgeKernel::kNone: break;
  }
  return {chi2, 1.0};
}

double squared_width(const PoseEdge& edge, double widening) {
  return edge.kernel_width * edge.kernel_width * (edge.kernel == EdgeKernel::kSwitchable ? widening : 1.0);
}

bool is_information(const Matrix3& information) {
  if (!information.allFinite() || (information - information.transpose()).norm() > 1e-6 * information.norm()) {
    return false;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(information, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()[0] >= -1e-9 * eigen.eigenvalues()[2];
}

}  // namespace

PoseGraph::PoseGraph(const PoseGraphParams& params) : params_(params) {}
PoseGraph::PoseGraph(const PoseGraph& other)
    : params_(other.params_), nodes_(other.nodes_), held_(other.held_), edges_(other.edges_), fixed_(other.fixed_) {}
PoseGraph::PoseGraph(PoseGraph&& other) noexcept = default;
PoseGraph& PoseGraph::operator=(const PoseGraph& other) {
  PoseGraph copy(other);
  return *this = std::move(copy);
}
PoseGraph& PoseGraph::operator=(PoseGraph&& other) noexcept = default;
PoseGraph::~PoseGraph() = default;

std::size_t PoseGraph::add_node(const Pose2& map_T_node) {
  nodes_.push_back(map_T_node);
  held_.push_back(false);
  system_.reset();
  connected_ = false;
  return nodes_.size() - 1;
}

void PoseGraph::fix(std::size_t node) {
  SEEKER_ASSERT(node < nodes_.size());
  fixed_ = node;
  system_.reset();
}

void PoseGraph::hold(std::size_t node) {
  held_.at(node) = true;
  system_.reset();
  connected_ = false;
}

void PoseGraph::set_pose(std::size_t node, const Pose2& map_T_node) {
  nodes_.at(node) = map_T_node;
  factored_ = false;
}

Result<std::size_t> PoseGraph::add_edge(const PoseEdge& edge) {
  if (edge.i >= nodes_.size() || edge.j >= nodes_.size() || edge.i == edge.j) {
    return fail(Errc::kInvalidArgument, "an edge joins two different nodes of the graph; add the nodes first");
  }
  if (!is_finite(edge.i_T_j) || !is_information(edge.information)) {
    return fail(Errc::kInvalidArgument,
                "the edge has a pose that is not finite or an information matrix that is not one; invert a covariance");
  }
  if (edge.kernel != EdgeKernel::kNone && !(edge.kernel_width > 0.0)) {
    return fail(Errc::kInvalidArgument, "a robust edge needs a kernel width above zero, in deviations");
  }
  edges_.push_back({edge, State::kEnabled, 0});
  system_.reset();
  return edges_.size() - 1;
}

void PoseGraph::set_enabled(std::size_t edge, bool enabled) {
  Entry& entry = edges_.at(edge);
  if (entry.state != State::kRemoved) {
    entry.state = enabled ? State::kEnabled : State::kDisabled;
    connected_ = false;
    factored_ = false;
  }
}

void PoseGraph::remove_edge(std::size_t edge) {
  edges_.at(edge).state = State::kRemoved;
  system_.reset();
  connected_ = false;
}

void PoseGraph::drop_nodes(std::size_t first, std::size_t end) {
  SEEKER_ASSERT(first <= end && end <= nodes_.size());
  const auto dropped = [&](std::size_t node) { return node >= first && node < end; };
  const auto renumbered = [&](std::size_t node) { return node < first ? node : node - (end - first); };
  SEEKER_ASSERT(!dropped(fixed_));
  std::erase_if(edges_, [&](const Entry& entry) {
    return entry.state == State::kRemoved || dropped(entry.edge.i) || dropped(entry.edge.j);
  });
  for (Entry& entry : edges_) {
    entry.edge.i = renumbered(entry.edge.i);
    entry.edge.j = renumbered(entry.edge.j);
  }
  const auto count = static_cast<std::ptrdiff_t>(end - first);
  const auto nodes = nodes_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto held = held_.begin() + static_cast<std::ptrdiff_t>(first);
  nodes_.erase(nodes, nodes + count);
  held_.erase(held, held + count);
  fixed_ = renumbered(fixed_);
  system_.reset();
  connected_ = false;
}

double PoseGraph::edge_chi2(std::size_t edge) const {
  const PoseEdge& e = edges_.at(edge).edge;
  const Eigen::Vector3d r = linearised(nodes_[e.i], nodes_[e.j], e.i_T_j).value;
  return r.dot(e.information * r);
}

double PoseGraph::edge_weight(std::size_t edge) const {
  const PoseEdge& e = edges_.at(edge).edge;
  return enabled(edge) ? robust(e.kernel, edge_chi2(edge), squared_width(e, 1.0)).weight : 0.0;
}

Status PoseGraph::check_connected() const {
  std::vector<std::size_t> parent(nodes_.size());
  for (std::size_t node = 0; node < nodes_.size(); ++node) {
    parent[node] = is_fixed(node) ? fixed_ : node;
  }
  const auto root = [&](std::size_t node) {
    while (parent[node] != node) {
      node = parent[node] = parent[parent[node]];
    }
    return node;
  };
  for (const Entry& entry : edges_) {
    if (entry.state == State::kEnabled) {
      parent[root(entry.edge.i)] = root(entry.edge.j);
    }
  }
  for (std::size_t node = 0; node < nodes_.size(); ++node) {
    if (root(node) != root(fixed_)) {
      return fail(Errc::kNotReady,
                  "node " + std::to_string(node) + " has no path to a fixed node; add or enable an edge that joins it");
    }
  }
  return {};
}

Status PoseGraph::prepare() {
  if (nodes_.empty()) {
    return fail(Errc::kNotReady, "the pose graph has no node; add one first");
  }
  if (!connected_) {
    if (auto status = check_connected(); !status) {
      return status;
    }
    connected_ = true;
  }
  if (!system_) {
    analyse();
  }
  return {};
}

void PoseGraph::analyse() {
  variables_.assign(nodes_.size(), 0);
  variable_count_ = 0;
  for (std::size_t node = 0; node < nodes_.size(); ++node) {
    if (!is_fixed(node)) {
      variables_[node] = variable_count_++;
    }
  }
  std::vector<BlockSystem::Pair> pairs;
  for (Entry& entry : edges_) {
    if (entry.state != State::kRemoved && !is_fixed(entry.edge.i) && !is_fixed(entry.edge.j)) {
      entry.slot = pairs.size();
      pairs.emplace_back(variables_[entry.edge.i], variables_[entry.edge.j]);
    }
  }
  system_ = std::make_unique<BlockSystem>(variable_count_, pairs);
  factored_ = false;
}

double PoseGraph::cost(double widening) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < edges_.size(); ++k) {
    const PoseEdge& edge = edges_[k].edge;
    if (has_say(edges_[k])) {
      sum += robust(edge.kernel, edge_chi2(k), squared_width(edge, widening)).cost;
    }
  }
  return sum;
}

void PoseGraph::linearise(double widening) {
  system_->set_zero();
  for (const Entry& entry : edges_) {
    if (!has_say(entry)) {
      continue;
    }
    const PoseEdge& edge = entry.edge;
    const Residual r = linearised(nodes_[edge.i], nodes_[edge.j], edge.i_T_j);
    const double chi2 = r.value.dot(edge.information * r.value);
    const Matrix3 information = robust(edge.kernel, chi2, squared_width(edge, widening)).weight * edge.information;
    const Matrix3 weighted_i = r.by_i.transpose() * information;
    const Matrix3 weighted_j = r.by_j.transpose() * information;
    if (!is_fixed(edge.i)) {
      system_->add_diagonal(variables_[edge.i], weighted_i * r.by_i);
      system_->add_right(variables_[edge.i], -weighted_i * r.value);
    }
    if (!is_fixed(edge.j)) {
      system_->add_diagonal(variables_[edge.j], weighted_j * r.by_j);
      system_->add_right(variables_[edge.j], -weighted_j * r.value);
    }
    if (!is_fixed(edge.i) && !is_fixed(edge.j)) {
      system_->add_pair(entry.slot, weighted_i * r.by_j);
    }
  }
}

double PoseGraph::first_widening() const {
  double widest = 1.0;
  for (std::size_t k = 0; k < edges_.size(); ++k) {
    const PoseEdge& edge = edges_[k].edge;
    if (has_say(edges_[k]) && edge.kernel == EdgeKernel::kSwitchable) {
      widest = std::max(widest, edge_chi2(k) / squared_width(edge, 1.0));
    }
  }
  return widest;
}

bool PoseGraph::move_nodes(double& largest_m, double& largest_rad) {
  largest_m = 0.0;
  largest_rad = 0.0;
  for (std::size_t node = 0; node < nodes_.size(); ++node) {
    if (is_fixed(node)) {
      continue;
    }
    const Eigen::Vector3d d = system_->solution(variables_[node]);
    if (!d.allFinite()) {
      return false;
    }
    Pose2& pose = nodes_[node];
    pose = {pose.x_m + d[0], pose.y_m + d[1], wrap_angle(pose.theta_rad + d[2])};
    largest_m = std::max(largest_m, d.head<2>().norm());
    largest_rad = std::max(largest_rad, std::abs(d[2]));
  }
  return true;
}

PoseGraph::Step PoseGraph::step(double& damping, double widening) {
  linearise(widening);
  const double before = cost(widening);
  const std::vector<Pose2> saved = nodes_;
  bool solved = false;
  for (; damping <= params_.max_damping; damping *= 10.0) {
    double largest_m = 0.0;
    double largest_rad = 0.0;
    if (system_->factor(damping)) {
      system_->solve();
      solved = move_nodes(largest_m, largest_rad) || solved;
      const bool small = largest_m < params_.stop_m && largest_rad < params_.stop_rad;
      if (cost(widening) <= before) {
        damping = std::max(params_.first_damping, 0.01 * damping);
        return small ? Step::kSmall : Step::kDone;
      }
      nodes_ = saved;
      if (small) {
        return Step::kSmall;
      }
    }
  }
  damping = params_.first_damping;
  return solved ? Step::kSmall : Step::kImpossible;
}

Result<OptimiseReport> PoseGraph::optimise(int max_iterations) {
  if (auto status = prepare(); !status) {
    return tl::unexpected<Error>(status.error());
  }
  OptimiseReport report;
  report.initial_chi2 = cost(1.0);
  const std::vector<Pose2> saved = nodes_;
  double damping = params_.first_damping;
  double widening = first_widening();
  // At most half of the iterations are spent until the true width is reached.
  const double rate = std::max(params_.graduation, std::pow(widening, 2.0 / std::max(1, max_iterations)));
  while (variable_count_ > 0 && report.iterations < max_iterations && !report.converged) {
    const Step done = step(damping, widening);
    if (done == Step::kImpossible) {
      nodes_ = saved;
      return fail(Errc::kInternal,
                  "the pose graph has no solution; give every edge information on all three components");
    }
    ++report.iterations;
    report.converged = done == Step::kSmall && widening <= 1.0;
    widening = std::max(1.0, widening / rate);
  }
  report.converged = report.converged || variable_count_ == 0;
  report.final_chi2 = cost(1.0);
  factored_ = false;
  for (std::size_t k = 0; k < edges_.size(); ++k) {
    const bool can = enabled(k) && edges_[k].edge.kernel == EdgeKernel::kSwitchable;
    report.switched_off += can && edge_weight(k) < params_.switched_off_weight ? 1 : 0;
  }
  return report;
}

Result<Matrix3> PoseGraph::relative_covariance(std::size_t base, std::size_t node) {
  if (base >= nodes_.size() || node >= nodes_.size()) {
    return fail(Errc::kInvalidArgument, "the graph has no such node");
  }
  if (auto status = prepare(); !status) {
    return tl::unexpected<Error>(status.error());
  }
  if (base == node || (is_fixed(base) && is_fixed(node))) {
    return Matrix3::Zero().eval();
  }
  if (!factored_) {
    linearise(1.0);
    if (!system_->factor(0.0)) {
      return fail(Errc::kInternal, "the pose graph has no covariance; give every edge information on all components");
    }
    factored_ = true;
  }
  const Residual r = linearised(nodes_[base], nodes_[node], {});
  Matrix3 covariance = Matrix3::Zero();
  if (!is_fixed(base) && !is_fixed(node)) {
    const std::size_t variable = variables_[base];
    const auto columns_base = system_->inverse_blocks(variable, {variable, variables_[node]});
    const Matrix3 cross = r.by_j * columns_base[1] * r.by_i.transpose();
    covariance += r.by_i * columns_base[0] * r.by_i.transpose() + cross + cross.transpose();
  } else if (!is_fixed(base)) {
    covariance += r.by_i * system_->inverse_blocks(variables_[base], {variables_[base]})[0] * r.by_i.transpose();
  }
  if (!is_fixed(node)) {
    covariance += r.by_j * system_->inverse_blocks(variables_[node], {variables_[node]})[0] * r.by_j.transpose();
  }
  return Matrix3(0.5 * (covariance + covariance.transpose()));
}

}  // namespace seeker::slam
