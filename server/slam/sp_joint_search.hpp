/// \file
/// Joint compatibility of pairs: the largest set of pairs that are compatible with each other (JCBB, Neira & Tardos
/// 2001).
#pragma once

#include <vector>

#include "server/slam/sp_rows.hpp"

namespace seeker::slam {

/// The quantile of chi-square that corresponds to `sigmas` of the normal distribution (Wilson & Hilferty; within 1 %
/// from 2 dof on).
[[nodiscard]] double chi2_limit(int dof, double sigmas);

/// The innovation of the rows taken so far; S = L L^T grows and shrinks by whole groups, O(rows^2) each.
class JointInnovation {
 public:
  explicit JointInnovation(const SpCovariance& p) : p_(&p) {}

  /// Pushes these rows and returns the increase of the squared distance by them, given all rows before.
  double push(const RowGroup& group);
  void pop();
  [[nodiscard]] double d2() const { return d2_; }
  [[nodiscard]] int dof() const { return static_cast<int>(rows_); }

 private:
  struct Entry {
    const RowGroup* group;
    Index first;
    double d2_before;
  };
  void reserve(Index rows);

  const SpCovariance* p_;
  std::vector<Entry> entries_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> l_;
  Eigen::VectorXd z_;  ///< L^-1 f
  Index rows_ = 0;
  double d2_ = 0.0;
};

/// One decision of the search: one of the options, or none.
struct JointItem {
  struct Option {
    RowGroup group;
    std::size_t segment = 0;
    /// Begin of the interval on the segment's x axis; two pairs of one segment may not overlap.
    double low_m = 0.0;
    double high_m = 0.0;   ///< end of that interval
    double penalty = 0.0;  ///< added to the squared distance when sets are compared
  };
  std::vector<Option> options;
};

struct JointChoice {
  std::vector<int> option;  ///< per item the option taken; -1 for none
  double d2 = 0.0;
  int dof = 0;
  int nodes = 0;
  bool capped = false;
};

/// The choice with the most items taken, and among equals with the smallest distance plus penalties. Items and options
/// are tried in their order: the first descent is the greedy solution, which is returned when `max_nodes` are used up.
[[nodiscard]] JointChoice search_joint(const SpCovariance& p, const std::vector<JointItem>& items, double sigmas,
                                       int max_nodes);

}  // namespace seeker::slam
