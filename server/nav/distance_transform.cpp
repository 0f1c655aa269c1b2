#include "server/nav/distance_transform.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace seeker::nav {
namespace {

/// Distance along the column only: one sweep up, one down, row by row for the cache.
Grid<float> column_distance(const Grid<std::uint8_t>& seed) {
  Grid<float> distance(seed.frame(), seed.width(), seed.height(), kFarCells);
  const auto width = static_cast<std::size_t>(seed.width());
  for (std::size_t k = 0; k < distance.cells().size(); ++k) {
    const float below = k >= width ? distance.cells()[k - width] + 1.0F : kFarCells;
    distance.cells()[k] = seed.cells()[k] != 0 ? 0.0F : std::min(below, kFarCells);
  }
  if (distance.cells().size() > width) {
    for (std::size_t k = distance.cells().size() - width; k-- > 0;) {
      distance.cells()[k] = std::min(distance.cells()[k], distance.cells()[k + width] + 1.0F);
    }
  }
  return distance;
}

/// Lower envelope of the parabolas (x - i)^2 + height[i]^2 over one row.
class RowEnvelope {
 public:
  explicit RowEnvelope(std::size_t width) : centre_(width), from_(width + 1), squared_(width) {}

  void apply(float* row, std::size_t width) {
    for (std::size_t i = 0; i < width; ++i) {
      squared_[i] = static_cast<double>(row[i]) * row[i];
    }
    build(width);
    std::size_t k = 0;
    for (std::size_t i = 0; i < width; ++i) {
      const auto x = static_cast<double>(i);
      while (from_[k + 1] < x) {
        ++k;
      }
      const double dx = x - static_cast<double>(centre_[k]);
      row[i] = std::min(kFarCells, static_cast<float>(std::sqrt(dx * dx + squared_[centre_[k]])));
    }
  }

 private:
  [[nodiscard]] double crossing(std::size_t a, std::size_t b) const {
    const auto xa = static_cast<double>(a);
    const auto xb = static_cast<double>(b);
    return ((squared_[b] + xb * xb) - (squared_[a] + xa * xa)) / (2.0 * (xb - xa));
  }

  void build(std::size_t width) {
    constexpr double kEverywhere = 1.0e30;
    std::size_t k = 0;
    centre_[0] = 0;
    from_[0] = -kEverywhere;
    from_[1] = kEverywhere;
    for (std::size_t i = 1; i < width; ++i) {
      double s = crossing(centre_[k], i);
      while (k > 0 && s <= from_[k]) {
        --k;
        s = crossing(centre_[k], i);
      }
      ++k;
      centre_[k] = i;
      from_[k] = s;
      from_[k + 1] = kEverywhere;
    }
  }

  std::vector<std::size_t> centre_;
  std::vector<double> from_;
  std::vector<double> squared_;
};

}  // namespace

Grid<float> distance_transform(const Grid<std::uint8_t>& seed) {
  Grid<float> distance = column_distance(seed);
  const auto width = static_cast<std::size_t>(seed.width());
  if (width == 0) {
    return distance;
  }
  RowEnvelope envelope(width);
  for (std::size_t start = 0; start < distance.cells().size(); start += width) {
    envelope.apply(distance.cells().data() + start, width);
  }
  return distance;
}

}  // namespace seeker::nav
