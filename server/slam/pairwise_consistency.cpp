#include "server/slam/pairwise_consistency.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>

#include "common/core/assert.hpp"

namespace seeker::slam {
namespace {

using Members = std::vector<std::size_t>;

/// Who agrees with whom.
class Agreement {
 public:
  Agreement(const std::vector<LoopEdge>& candidates, const RelativePose& odometry, double gate_chi2,
            const Independent& independent)
      : size_(candidates.size()), chi2_(size_ * size_, 0.0), alike_(size_ * size_, false), gate_(gate_chi2) {
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t j = i + 1; j < size_; ++j) {
        const double chi2 = cycle_chi2(candidates[i], candidates[j], odometry);
        chi2_[i * size_ + j] = chi2;
        chi2_[j * size_ + i] = chi2;
        const bool alike = independent && !independent(i, j);
        alike_[i * size_ + j] = alike;
        alike_[j * size_ + i] = alike;
      }
    }
  }

  [[nodiscard]] bool agree(std::size_t i, std::size_t j) const { return chi2(i, j) <= gate_; }
  /// ... and may be members together.
  [[nodiscard]] bool support(std::size_t i, std::size_t j) const { return agree(i, j) && !alike_[i * size_ + j]; }
  [[nodiscard]] double chi2(std::size_t i, std::size_t j) const { return chi2_[i * size_ + j]; }
  [[nodiscard]] double sum(const Members& members) const {
    double total = 0.0;
    for (const std::size_t i : members) {
      for (const std::size_t j : members) {
        total += chi2(i, j);
      }
    }
    return total;
  }

 private:
  std::size_t size_;
  std::vector<double> chi2_;
  std::vector<bool> alike_;
  double gate_;
};

/// Maximum clique; see Tomita and Seki, "An efficient branch-and-bound algorithm for finding a maximum clique".
class CliqueSearch {
 public:
  CliqueSearch(const Agreement& agreement, std::size_t max_steps) : agreement_(agreement), left_(max_steps) {}

  Members find(Members open) {
    const auto degree = [&](std::size_t i) {
      return std::count_if(open.begin(), open.end(), [&](std::size_t j) { return agreement_.support(i, j); });
    };
    std::vector<std::pair<std::ptrdiff_t, std::size_t>> by_degree;
    for (const std::size_t i : open) {
      by_degree.emplace_back(-degree(i), i);
    }
    std::sort(by_degree.begin(), by_degree.end());
    std::transform(by_degree.begin(), by_degree.end(), open.begin(), [](const auto& entry) { return entry.second; });
    expand(open);
    std::sort(best_.begin(), best_.end());
    return best_;
  }
  [[nodiscard]] bool exact() const { return left_ > 0; }

 private:
  /// Orders `open` by colour; the colour number bounds the clique among it and all before it.
  std::vector<std::size_t> colour(Members& open) const {
    std::vector<Members> classes;
    for (const std::size_t i : open) {
      const auto free = std::find_if(classes.begin(), classes.end(), [&](const Members& same) {
        return std::none_of(same.begin(), same.end(), [&](std::size_t j) { return agreement_.support(i, j); });
      });
      (free == classes.end() ? classes.emplace_back() : *free).push_back(i);
    }
    std::vector<std::size_t> bounds;
    open.clear();
    for (std::size_t c = 0; c < classes.size(); ++c) {
      open.insert(open.end(), classes[c].begin(), classes[c].end());
      bounds.resize(open.size(), c + 1);
    }
    return bounds;
  }

  void keep_if_better() {
    const double sum = agreement_.sum(current_);
    if (current_.size() > best_.size() || (current_.size() == best_.size() && sum < best_sum_)) {
      best_ = current_;
      best_sum_ = sum;
    }
  }

  void expand(Members open) {
    const std::vector<std::size_t> bounds = colour(open);
    while (!open.empty() && left_ > 0) {
      --left_;
      if (current_.size() + bounds[open.size() - 1] <= best_.size()) {
        return;
      }
      const std::size_t next = open.back();
      open.pop_back();
      current_.push_back(next);
      Members inner;
      std::copy_if(open.begin(), open.end(), std::back_inserter(inner),
                   [&](std::size_t j) { return agreement_.support(next, j); });
      if (inner.empty()) {
        keep_if_better();
      } else {
        expand(std::move(inner));
      }
      current_.pop_back();
    }
  }

  const Agreement& agreement_;
  std::size_t left_;
  Members current_;
  Members best_;
  double best_sum_ = std::numeric_limits<double>::infinity();
};

std::size_t rival_size(const Agreement& agreement, const Members& members, std::size_t candidates,
                       std::size_t max_steps) {
  Members against;
  for (std::size_t i = 0; i < candidates; ++i) {
    const bool contradicts =
        std::any_of(members.begin(), members.end(), [&](std::size_t m) { return m != i && !agreement.agree(i, m); });
    if (contradicts && !std::binary_search(members.begin(), members.end(), i)) {
      against.push_back(i);
    }
  }
  return against.empty() ? 0 : CliqueSearch(agreement, max_steps).find(against).size();
}

Members followers(const Agreement& agreement, const Members& members, std::size_t candidates) {
  Members found;
  for (std::size_t i = 0; i < candidates; ++i) {
    const bool agrees =
        std::all_of(members.begin(), members.end(), [&](std::size_t m) { return m != i && agreement.agree(i, m); });
    if (agrees) {
      found.push_back(i);
    }
  }
  return found;
}

}  // namespace

OdometryChain::OdometryChain(const std::vector<UncertainPose>& previous_T_next) : from_start_(1) {
  from_start_.reserve(previous_T_next.size() + 1);
  for (const UncertainPose& step : previous_T_next) {
    from_start_.push_back(compose(from_start_.back(), step));
  }
}

UncertainPose OdometryChain::between(std::size_t from, std::size_t to) const {
  SEEKER_ASSERT(from < size() && to < size());
  if (from == to) {
    return {};
  }
  if (from > to) {
    return invert(between(to, from));
  }
  // What came after `from` is independent of what came before it: undo the composition.
  const UncertainPose& a = from_start_[from];
  const UncertainPose& c = from_start_[to];
  const Pose2 step = inverse(a.a_T_b) * c.a_T_b;
  const Matrix3 by_a = compose_jacobian_a(a.a_T_b, step);
  const Matrix3 by_step = compose_jacobian_b(a.a_T_b, step);  // a rotation: its transpose is its inverse
  const Matrix3 covariance = by_step.transpose() * (c.covariance - by_a * a.covariance * by_a.transpose()) * by_step;
  return {step, 0.5 * (covariance + covariance.transpose())};
}

double cycle_chi2(const LoopEdge& first, const LoopEdge& second, const RelativePose& odometry) {
  const UncertainPose out = compose(first.a_T_b, odometry(first.b, second.b));
  const UncertainPose back = compose(invert(second.a_T_b), odometry(second.a, first.a));
  const UncertainPose cycle = compose(out, back);
  const Eigen::Vector3d error(cycle.a_T_b.x_m, cycle.a_T_b.y_m, cycle.a_T_b.theta_rad);
  // Two loops between the same nodes without any error of their own would leave nothing to divide by.
  const Matrix3 covariance = cycle.covariance + 1e-12 * Matrix3::Identity();
  return error.dot(covariance.ldlt().solve(error));
}

ConsistentSet largest_consistent_set(const std::vector<LoopEdge>& candidates, const RelativePose& odometry,
                                     const ConsistencyParams& params, const Independent& independent) {
  ConsistentSet set;
  if (candidates.empty()) {
    return set;
  }
  const Agreement agreement(candidates, odometry, params.gate_chi2, independent);
  Members all(candidates.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  CliqueSearch search(agreement, params.max_search);
  set.members = search.find(std::move(all));
  set.exact = search.exact();
  set.followers = followers(agreement, set.members, candidates.size());
  set.rival_size = rival_size(agreement, set.members, candidates.size(), params.max_search);
  return set;
}

}  // namespace seeker::slam
