/// \file
/// A spatial index that finds the points near a position without visiting all of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "server/localize/geometry.hpp"

namespace seeker::localize {

/// Points by the cubic cell in which they lie.
class PointGrid {
 public:
  explicit PointGrid(double cell_m) : cell_m_(cell_m) {}

  void insert(std::size_t index, const Point3& p) { cells_[key_of(p)].push_back({index, p}); }
  /// Moves a point; `from` must be the position at which it was inserted.
  void move(std::size_t index, const Point3& from, const Point3& to) {
    std::erase_if(cells_[key_of(from)], [index](const Entry& entry) { return entry.index == index; });
    insert(index, to);
  }
  void clear() { cells_.clear(); }

  /// Calls `visit(index)` for each point at most `radius_m` from p, in an order that depends on the points alone.
  template <class Visit>
  void for_near(const Point3& p, double radius_m, Visit visit) const {
    const std::int64_t low[3] = {cell(p.x() - radius_m), cell(p.y() - radius_m), cell(p.z() - radius_m)};
    const std::int64_t high[3] = {cell(p.x() + radius_m), cell(p.y() + radius_m), cell(p.z() + radius_m)};
    for (std::int64_t i = low[0]; i <= high[0]; ++i) {
      for (std::int64_t j = low[1]; j <= high[1]; ++j) {
        for (std::int64_t k = low[2]; k <= high[2]; ++k) {
          visit_cell(key(i, j, k), p, radius_m, visit);
        }
      }
    }
  }

 private:
  struct Entry {
    std::size_t index;
    Point3 p;
  };

  template <class Visit>
  void visit_cell(std::uint64_t at, const Point3& p, double radius_m, Visit& visit) const {
    const auto found = cells_.find(at);
    if (found == cells_.end()) {
      return;
    }
    for (const Entry& entry : found->second) {
      if ((entry.p - p).squaredNorm() <= radius_m * radius_m) {
        visit(entry.index);
      }
    }
  }

  [[nodiscard]] std::int64_t cell(double x_m) const { return static_cast<std::int64_t>(std::floor(x_m / cell_m_)); }
  [[nodiscard]] std::uint64_t key_of(const Point3& p) const { return key(cell(p.x()), cell(p.y()), cell(p.z())); }
  /// 21 bits per axis: no two cells of a building share a key.
  [[nodiscard]] static std::uint64_t key(std::int64_t i, std::int64_t j, std::int64_t k) {
    constexpr unsigned kBits = 21;
    constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;
    return (static_cast<std::uint64_t>(i) & kMask) | ((static_cast<std::uint64_t>(j) & kMask) << kBits) |
           ((static_cast<std::uint64_t>(k) & kMask) << (2 * kBits));
  }

  double cell_m_;
  std::unordered_map<std::uint64_t, std::vector<Entry>> cells_;
};

}  // namespace seeker::localize
