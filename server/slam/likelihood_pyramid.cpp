#include "server/slam/likelihood_pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/core/angle.hpp"

namespace seeker::slam {
namespace {

constexpr int kRun = 16;  ///< bytes added at once
constexpr double kFull = 255.0;

int round_up(int value, int unit) { return (value + unit - 1) / unit * unit; }

int floor_div(int value, int by) { return value >= 0 ? value / by : -((-value + by - 1) / by); }

/// One fixed run: compilers make a few vector instructions of it.
void add_run(std::uint16_t* __restrict sums, const std::uint8_t* __restrict values) {
  for (int k = 0; k < kRun; ++k) {
    sums[k] = static_cast<std::uint16_t>(sums[k] + values[k]);
  }
}

}  // namespace

LikelihoodPyramid::BlockSums::BlockSums(int columns_in, int rows_in)
    : columns(columns_in),
      rows(rows_in),
      stride(round_up(columns_in, kRun) + kRun),
      sums(static_cast<std::size_t>(stride) * static_cast<std::size_t>(rows_in), 0) {}

LikelihoodPyramid::LikelihoodPyramid(const PyramidParams& params, const Point2& low, const Point2& high)
    : params_(params) {
  // A block that begins outside of the grid must hold nothing: the margin is a block and the reach of a point.
  const int block = 1 << params.coarse_level;
  const double margin_m = params.reach_m + (block + 1) * params.resolution_m;
  frame_ = {low - Point2::Constant(margin_m), params.resolution_m};
  const Point2 size = high - low + Point2::Constant(2.0 * margin_m);
  width_ = round_up(static_cast<int>(std::ceil(size.x() / params.resolution_m)), block);
  height_ = round_up(static_cast<int>(std::ceil(size.y() / params.resolution_m)), block);
  block_columns_ = width_ / block;
  block_rows_ = height_ / block;
  block_stride_ = round_up(block_columns_, kRun) + kRun;
}

std::size_t LikelihoodPyramid::needed_bytes() const {
  const auto level = static_cast<double>(width_) * height_ * params_.directions;
  const double phases = level / block_columns_ * block_stride_;
  return static_cast<std::size_t>(level * params_.coarse_level + phases);
}

Result<LikelihoodPyramid> LikelihoodPyramid::build(const std::vector<OrientedPoint>& points_map,
                                                   const PyramidParams& params) {
  constexpr int kMaxLevel = 8;
  const bool sizes = params.resolution_m > 0.0 && params.sigma_m > 0.0 && params.reach_m >= 0.0;
  if (!sizes || params.directions < 1 || params.coarse_level < 1 || params.coarse_level > kMaxLevel) {
    return fail(Errc::kInvalidArgument,
                "the search grid needs cells and sigma above zero, a direction and a coarse level from 1 to 8");
  }
  if (points_map.empty()) {
    return fail(Errc::kInvalidArgument, "there is no point to search among; map something first");
  }
  Point2 low = points_map.front().p;
  Point2 high = low;
  for (const OrientedPoint& point : points_map) {
    if (!point.p.allFinite() || !point.normal.allFinite()) {
      return fail(Errc::kInvalidArgument, "a point of the map is not finite");
    }
    low = low.cwiseMin(point.p);
    high = high.cwiseMax(point.p);
  }
  constexpr double kMaxCells = 1e6;  // along one side: what fits into an int whatever the other side is
  if ((high - low).maxCoeff() > kMaxCells * params.resolution_m) {
    return fail(Errc::kTooLarge, "the map's points are kilometres apart; a pose among them is broken");
  }
  LikelihoodPyramid pyramid(params, low, high);
  if (pyramid.needed_bytes() > params.max_bytes) {
    return fail(Errc::kTooLarge, "the search grid would need " + std::to_string(pyramid.needed_bytes() / 1'000'000) +
                                     " MB; use a larger resolution_m, or only the points about a place");
  }
  pyramid.levels_.emplace_back(pyramid.cell(params.directions, 0, 0), std::uint8_t{0});
  for (const OrientedPoint& point : points_map) {
    pyramid.stamp(point);
  }
  pyramid.build_levels();
  return pyramid;
}

std::size_t LikelihoodPyramid::bytes() const { return needed_bytes(); }

int LikelihoodPyramid::direction_of(double normal_rad) const {
  const double step_rad = kTwoPi / params_.directions;
  const int direction = static_cast<int>(std::lround(normal_rad / step_rad)) % params_.directions;
  return direction < 0 ? direction + params_.directions : direction;
}

void LikelihoodPyramid::stamp(const OrientedPoint& point) {
  const int reach = static_cast<int>(std::ceil(params_.reach_m / params_.resolution_m));
  const CellIndex at = frame_.cell_of(point.p);
  const double normal_rad = std::atan2(point.normal.y(), point.normal.x());
  for (int direction = 0; direction < params_.directions; ++direction) {
    const double off_rad = wrap_angle(normal_rad - direction * kTwoPi / params_.directions);
    if (std::abs(off_rad) > params_.direction_gate_rad) {
      continue;
    }
    for (int j = at.j - reach; j <= at.j + reach; ++j) {
      for (int i = at.i - reach; i <= at.i + reach; ++i) {
        const double d2 = (frame_.centre_of({i, j}) - point.p).squaredNorm();
        if (d2 <= params_.reach_m * params_.reach_m) {
          const double likelihood = kFull * std::exp(-0.5 * d2 / (params_.sigma_m * params_.sigma_m));
          std::uint8_t& value = levels_.front()[cell(direction, i, j)];
          value = std::max(value, static_cast<std::uint8_t>(std::lround(likelihood)));
        }
      }
    }
  }
}

std::vector<std::uint8_t> LikelihoodPyramid::doubled(const std::vector<std::uint8_t>& below, int shift) const {
  std::vector<std::uint8_t> above = below;
  const auto rows = static_cast<std::size_t>(height_) * static_cast<std::size_t>(params_.directions);
  const auto width = static_cast<std::size_t>(width_);
  const auto step = static_cast<std::size_t>(shift);
  for (std::size_t row = 0; row < rows; ++row) {
    std::uint8_t* values = above.data() + row * width;
    for (std::size_t i = 0; i + step < width; ++i) {
      values[i] = std::max(values[i], values[i + step]);
    }
  }
  for (std::size_t row = 0; row + step < rows; ++row) {
    // The last rows of a direction would look into the next one; they lie in the margin, where nothing is.
    std::uint8_t* values = above.data() + row * width;
    const std::uint8_t* next = values + step * width;
    for (std::size_t i = 0; i < width; ++i) {
      values[i] = std::max(values[i], next[i]);
    }
  }
  return above;
}

void LikelihoodPyramid::build_levels() {
  for (int level = 1; level < params_.coarse_level; ++level) {
    levels_.push_back(doubled(levels_.back(), 1 << (level - 1)));
  }
  build_phases(doubled(levels_.back(), 1 << (params_.coarse_level - 1)));
}

void LikelihoodPyramid::build_phases(const std::vector<std::uint8_t>& top) {
  const int block = 1 << params_.coarse_level;
  phases_.assign(static_cast<std::size_t>(params_.directions) * static_cast<std::size_t>(height_ * block) *
                     static_cast<std::size_t>(block_stride_),
                 0);
  std::uint8_t* out = phases_.data();
  for (int direction = 0; direction < params_.directions; ++direction) {
    for (int phase = 0; phase < block * block; ++phase) {
      for (int row = 0; row < block_rows_; ++row, out += block_stride_) {
        const std::uint8_t* from = top.data() + cell(direction, phase % block, row * block + phase / block);
        for (int column = 0; column < block_columns_; ++column) {
          out[column] = from[column * block];
        }
      }
    }
  }
}

void LikelihoodPyramid::add_blocks(int direction, CellIndex first, BlockSums& sums) const {
  const int block = 1 << params_.coarse_level;
  const CellIndex whole{floor_div(first.i, block), floor_div(first.j, block)};
  const int phase = (first.j - whole.j * block) * block + (first.i - whole.i * block);
  const int first_column = std::max(0, -whole.i);
  const int last_column = std::min(sums.columns, block_columns_ - whole.i);
  const int first_row = std::max(0, -whole.j);
  const int last_row = std::min(sums.rows, block_rows_ - whole.j);
  const std::uint8_t* plane = phases_.data() + static_cast<std::size_t>(direction * block * block + phase) *
                                                   static_cast<std::size_t>(block_rows_ * block_stride_);
  for (int row = first_row; row < last_row; ++row) {
    // Both rows are padded: the last run may go beyond their ends, where zeros are added to what nobody reads.
    std::uint16_t* to = sums.sums.data() + row * sums.stride + first_column;
    const std::uint8_t* from = plane + (row + whole.j) * block_stride_ + first_column + whole.i;
    for (int column = first_column; column < last_column; column += kRun, to += kRun, from += kRun) {
      add_run(to, from);
    }
  }
}

}  // namespace seeker::slam
