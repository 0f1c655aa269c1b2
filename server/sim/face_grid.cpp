#include "server/sim/face_grid.hpp"

namespace seeker::sim {
namespace {

constexpr double kCell_m = 0.5;
constexpr double kMaxCells = 512.0;    ///< on a side
constexpr double kMargin_m = 0.5;      ///< around the bounds: thick walls reach over them
constexpr double kCellSlack_m = 1e-6;  ///< a segment on a border belongs to both cells

}  // namespace

FaceGrid::FaceGrid(const Point2& min_corner, const Point2& max_corner, std::vector<Segment> segments)
    : segments_(std::move(segments)) {
  Point2 low = min_corner;
  Point2 high = max_corner;
  for (const Segment& s : segments_) {
    low = low.cwiseMin(s.a).cwiseMin(s.b());
    high = high.cwiseMax(s.a).cwiseMax(s.b());
  }
  origin_ = low - Point2::Constant(kMargin_m);
  const Point2 side = high - low + Point2::Constant(2.0 * kMargin_m);
  cell_m_ = std::max(kCell_m, side.maxCoeff() / kMaxCells);
  cells_per_m_ = 1.0 / cell_m_;
  columns_ = std::max(1, static_cast<int>(std::ceil(side.x() / cell_m_)));
  rows_ = std::max(1, static_cast<int>(std::ceil(side.y() / cell_m_)));

  std::vector<std::vector<std::uint32_t>> cells(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (std::size_t n = 0; n < segments_.size(); ++n) {
    const Segment& s = segments_[n];
    const Point2 from = s.a.cwiseMin(s.b()) - Point2::Constant(kCellSlack_m);
    const Point2 to = s.a.cwiseMax(s.b()) + Point2::Constant(kCellSlack_m);
    for (int j = row(from.y()); j <= row(to.y()); ++j) {
      for (int i = column(from.x()); i <= column(to.x()); ++i) {
        if (touches(s, i, j)) {
          cells[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i)]
              .push_back(static_cast<std::uint32_t>(n));
        }
      }
    }
  }
  starts_.assign(1, 0);
  for (const auto& list : cells) {
    items_.insert(items_.end(), list.begin(), list.end());
    starts_.push_back(static_cast<std::uint32_t>(items_.size()));
  }
}

bool FaceGrid::touches(const Segment& segment, int i, int j) const {
  // Separating axis: the segment's normal; the boxes already overlap along x and y.
  const Point2 centre = origin_ + cell_m_ * Point2(i + 0.5, j + 0.5);
  const Point2 normal(-segment.direction.y(), segment.direction.x());
  const double reach = 0.5 * cell_m_ * (std::abs(normal.x()) + std::abs(normal.y()));
  return std::abs(normal.dot(centre - segment.a)) <= reach + kCellSlack_m;
}

}  // namespace seeker::sim
