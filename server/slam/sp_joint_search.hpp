/// \file
/// Joint compatibility of pairs: the largest set that fits together (JCBB, Neira & Tardos 2001).
#pragma once

#include <vector>

#include "server/slam/sp_rows.hpp"

namespace seeker::slam {

/// Quantile of chi-square where the normal distribution has `sigmas` (Wilson & Hilferty; 1 % off at worst for 2 dof
/// on).
[[nodiscard]] double chi2_limit(int dof, double sigmas);

/// Rows taken together so far; S = L L^T grows and shrinks by whole groups, O(rows^2) each.
class JointInnovation {
 public:
  explicit JointInnovation(const SpCovariance& p) : p_(&p) {}

  /// The increase of the squared distance by these rows, given all rows before; they are on the stack then.
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

/// One thing to be decided: one of its options, or none.
struct JointItem {
  struct Option {
    RowGroup group;
    std::size_t segment = 0;
    double low_m = 0.0;  ///< interval on the segment's x axis; two pairs of one segment may not overlap
    double high_m = 0.0;
    double penalty = 0.0;  ///< added to the squared distance when sets are compared
  };
  std::vector<Option> options;
};

struct JointChoice {
  std::vector<int> option;  ///< per item the option taken, -1: none
  double d2 = 0.0;
  int dof = 0;
  int nodes = 0;
  bool capped = false;
};

/// The choice with most items taken, the smaller distance with penalties among equals. Items are tried in their order
/// and options in theirs: the first dive is the greedy answer, which is what stays when `max_nodes` are used up.
[[nodiscard]] JointChoice search_joint(const SpCovariance& p, const std::vector<JointItem>& items, double sigmas,
                                       int max_nodes);

}  // namespace seeker::slam
