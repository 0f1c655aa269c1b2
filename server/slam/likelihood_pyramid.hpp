/// \file
/// Multi-resolution likelihood field of a map: how well a point fits at each cell, with upper bounds for blocks of
/// cells, for searches over all poses.
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/result.hpp"
#include "server/slam/oriented_points.hpp"

namespace seeker::slam {

struct PyramidParams {
  double resolution_m = 0.05;
  double sigma_m = 0.08;  ///< standard deviation of the distance between a point and the nearest point of the map
  double reach_m = 0.2;   ///< beyond this distance the likelihood is 0
  /// The number of directions of the surface normal for which the field is kept: a wall seen from the other side does
  /// not fit.
  int directions = 8;
  double direction_gate_rad = 0.8;      ///< a surface counts in the directions within this angle of its normal
  int coarse_level = 3;                 ///< blocks of 2^level cells at the top
  std::size_t max_bytes = 512'000'000;  ///< limit of the memory; a larger map needs a larger cell
};

/// Likelihood 0 to 255 of a point at a cell, for each direction of its normal. Level h holds the maximum over the
/// square of 2^h cells that begins at a cell: the bound of Hess et al., ICRA 2016. The top level is stored by phase
/// (cell index modulo the block), so that the sums of all blocks of the map come from contiguous bytes.
class LikelihoodPyramid {
 public:
  /// Fails with kTooLarge when the points span more than max_bytes, and with kInvalidArgument when there is no point, a
  /// point is not finite or the parameters make no grid.
  [[nodiscard]] static Result<LikelihoodPyramid> build(const std::vector<OrientedPoint>& points_map,
                                                       const PyramidParams& params = {});

  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int coarse_level() const { return params_.coarse_level; }
  [[nodiscard]] const PyramidParams& params() const { return params_; }
  [[nodiscard]] std::size_t bytes() const;

  /// The direction index to which a normal of this angle (in the frame `map`) belongs.
  [[nodiscard]] int direction_of(double normal_rad) const;
  /// The bound at a level below the top; 0 outside the map.
  [[nodiscard]] std::uint8_t value(int level, int direction, int i, int j) const {
    if (static_cast<unsigned>(i) >= static_cast<unsigned>(width_) ||
        static_cast<unsigned>(j) >= static_cast<unsigned>(height_)) {
      return 0;
    }
    return levels_[static_cast<std::size_t>(level)][cell(direction, i, j)];
  }
  /// The likelihood of a point at this position, at the full resolution.
  [[nodiscard]] std::uint8_t value(const Point2& p_map, int direction) const {
    const CellIndex c = frame_.cell_of(p_map);
    return value(0, direction, c.i, c.j);
  }

  /// Sums of bounds, one per block; the stride of the rows leaves room for contiguous additions.
  struct BlockSums {
    BlockSums(int columns_in, int rows_in);
    [[nodiscard]] std::uint16_t at(int column, int row) const {
      return sums[static_cast<std::size_t>(row) * static_cast<std::size_t>(stride) + static_cast<std::size_t>(column)];
    }
    int columns;
    int rows;
    int stride;
    std::vector<std::uint16_t> sums;
  };
  /// Adds, for every block (column, row), the bound of a point whose cell in block (0, 0) begins at `first`.
  void add_blocks(int direction, CellIndex first, BlockSums& sums) const;

 private:
  LikelihoodPyramid(const PyramidParams& params, const Point2& low, const Point2& high);

  [[nodiscard]] std::size_t cell(int direction, int i, int j) const {
    return (static_cast<std::size_t>(direction) * static_cast<std::size_t>(height_) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(i);
  }
  [[nodiscard]] std::size_t needed_bytes() const;
  void stamp(const OrientedPoint& point);
  void build_levels();
  void build_phases(const std::vector<std::uint8_t>& top);
  [[nodiscard]] std::vector<std::uint8_t> doubled(const std::vector<std::uint8_t>& below, int shift) const;

  PyramidParams params_;
  GridFrame frame_;
  int width_ = 0;
  int height_ = 0;
  int block_columns_ = 0;
  int block_rows_ = 0;
  int block_stride_ = 0;
  std::vector<std::vector<std::uint8_t>> levels_;  ///< the levels below the top
  std::vector<std::uint8_t> phases_;               ///< the top level, by direction, phase, row and column
};

}  // namespace seeker::slam
