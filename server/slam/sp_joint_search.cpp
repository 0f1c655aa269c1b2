#include "server/slam/sp_joint_search.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::slam {

double chi2_limit(int dof, double sigmas) {
  const double n = std::max(dof, 1);
  const double a = 2.0 / (9.0 * n);
  const double root = 1.0 - a + sigmas * std::sqrt(a);
  return n * root * root * root;
}

void JointInnovation::reserve(Index rows) {
  if (rows <= l_.rows()) {
    return;
  }
  const Index capacity = std::max<Index>(32, 2 * rows);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> l(capacity, capacity);
  l.topLeftCorner(rows_, rows_) = l_.topLeftCorner(rows_, rows_);
  l_.swap(l);
  z_.conservativeResize(capacity);
}

double JointInnovation::push(const RowGroup& group) {
  const Index count = group.rows();
  reserve(rows_ + count);
  entries_.push_back({&group, rows_, d2_});
  auto own = l_.block(rows_, 0, count, rows_);
  for (const Entry& entry : entries_) {
    if (entry.group != &group) {
      own.middleCols(entry.first, entry.group->rows()) = innovation_covariance(*p_, group, *entry.group);
    }
  }
  // Row by row of L: X L^T = S_new,old.
  for (Index r = 0; r < count; ++r) {
    for (Index j = 0; j < rows_; ++j) {
      own(r, j) = (own(r, j) - own.row(r).head(j).dot(l_.row(j).head(j))) / l_(j, j);
    }
  }
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4> s = innovation_covariance(*p_, group, group);
  s.noalias() -= own * own.transpose();
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1> f = group.f;
  f.noalias() -= own * z_.head(rows_);
  double increase = 0.0;
  for (Index r = 0; r < count; ++r) {
    for (Index j = 0; j <= r; ++j) {
      double value = s(r, j);
      for (Index k = 0; k < j; ++k) {
        value -= l_(rows_ + r, rows_ + k) * l_(rows_ + j, rows_ + k);
      }
      l_(rows_ + r, rows_ + j) = j == r ? std::sqrt(std::max(value, 1e-300)) : value / l_(rows_ + j, rows_ + j);
    }
    double z = f(r);
    for (Index k = 0; k < r; ++k) {
      z -= l_(rows_ + r, rows_ + k) * z_(rows_ + k);
    }
    z_(rows_ + r) = z / l_(rows_ + r, rows_ + r);
    increase += z_(rows_ + r) * z_(rows_ + r);
  }
  rows_ += count;
  d2_ += increase;
  return increase;
}

void JointInnovation::pop() {
  rows_ = entries_.back().first;
  d2_ = entries_.back().d2_before;
  entries_.pop_back();
}

namespace {

class Search {
 public:
  Search(const SpCovariance& p, const std::vector<JointItem>& items, double sigmas, int max_nodes)
      : items_(items), joint_(p), sigmas_(sigmas), max_nodes_(max_nodes), present_(items.size(), -1) {
    best_.option = present_;
  }

  JointChoice run() {
    descend(0, 0, 0.0);
    best_.nodes = nodes_;
    best_.capped = nodes_ >= max_nodes_;
    return best_;
  }

 private:
  void descend(std::size_t item, int taken, double penalty) {
    const double cost = joint_.d2() + penalty;
    if (item == items_.size()) {
      if (taken > best_taken_ || (taken == best_taken_ && cost < best_cost_)) {
        best_taken_ = taken;
        best_cost_ = cost;
        best_.option = present_;
        best_.d2 = joint_.d2();
        best_.dof = joint_.dof();
      }
      return;
    }
    const auto left = static_cast<int>(items_.size() - item);
    if (taken + left < best_taken_ || (taken + left == best_taken_ && cost >= best_cost_)) {
      return;
    }
    const std::vector<JointItem::Option>& options = items_[item].options;
    for (std::size_t k = 0; k < options.size(); ++k) {
      if (is_taken(item, options[k])) {
        continue;
      }
      if (nodes_ >= max_nodes_ && best_taken_ >= 0) {
        return;
      }
      ++nodes_;
      joint_.push(options[k].group);
      if (joint_.d2() <= chi2_limit(joint_.dof(), sigmas_)) {
        present_[item] = static_cast<int>(k);
        descend(item + 1, taken + 1, penalty + options[k].penalty);
        present_[item] = -1;
      }
      joint_.pop();
    }
    if (nodes_ < max_nodes_ || best_taken_ < 0) {
      descend(item + 1, taken, penalty);
    }
  }

  /// The segment is paired already where this observation lies.
  [[nodiscard]] bool is_taken(std::size_t item, const JointItem::Option& option) const {
    for (std::size_t other = 0; other < item; ++other) {
      if (present_[other] < 0) {
        continue;
      }
      const JointItem::Option& taken = items_[other].options[static_cast<std::size_t>(present_[other])];
      if (taken.segment == option.segment && taken.low_m < option.high_m && option.low_m < taken.high_m) {
        return true;
      }
    }
    return false;
  }

  const std::vector<JointItem>& items_;
  JointInnovation joint_;
  double sigmas_;
  int max_nodes_;
  int nodes_ = 0;
  int best_taken_ = -1;
  double best_cost_ = 0.0;
  std::vector<int> present_;
  JointChoice best_;
};

}  // namespace

JointChoice search_joint(const SpCovariance& p, const std::vector<JointItem>& items, double sigmas, int max_nodes) {
  return Search(p, items, sigmas, max_nodes).run();
}

}  // namespace seeker::slam
