#include "server/slam/reference_cloud.hpp"

#include <cstdint>
#include <optional>
#include <utility>

#include <nanoflann.hpp>

namespace seeker::slam {
namespace {

constexpr double kPresenceCell_m = 0.1;
constexpr std::size_t kLeafSize = 8;
/// A cloud wider than this comes from a broken pose; its grid would not fit in memory.
constexpr double kMaxExtent_m = 400.0;

/// The nearest point within a radius, in the shape nanoflann asks for: knowing the radius from the start, the search
/// leaves out most of the tree (bench_slam: reference_nearest).
class NearestWithin {
 public:
  explicit NearestWithin(double radius_m) : worst_m2_(radius_m * radius_m) {}

  [[nodiscard]] std::size_t size() const { return found_ ? 1 : 0; }
  [[nodiscard]] bool full() const { return true; }
  bool addPoint(double distance_m2, std::uint32_t index) {  // NOLINT(readability-identifier-naming): nanoflann's name
    if (distance_m2 < worst_m2_) {
      worst_m2_ = distance_m2;
      index_ = index;
      found_ = true;
    }
    return true;
  }
  [[nodiscard]] double worstDist() const { return worst_m2_; }  // NOLINT(readability-identifier-naming)
  [[nodiscard]] std::optional<std::uint32_t> index() const {
    return found_ ? std::optional<std::uint32_t>(index_) : std::nullopt;
  }

 private:
  double worst_m2_;
  std::uint32_t index_ = 0;
  bool found_ = false;
};

/// View of the points in the shape nanoflann asks for; its names are the library's.
struct PointAdaptor {
  const std::vector<OrientedPoint>* points;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points->size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t index, std::size_t dim) const {
    return (*points)[index].p[static_cast<Eigen::Index>(dim)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};

Grid<std::uint8_t> presence_grid(const std::vector<OrientedPoint>& points) {
  if (points.empty()) {
    return {};
  }
  Point2 low = points.front().p;
  Point2 high = low;
  for (const OrientedPoint& point : points) {
    low = low.cwiseMin(point.p);
    high = high.cwiseMax(point.p);
  }
  if ((high - low).maxCoeff() > kMaxExtent_m) {
    return {};
  }
  const GridFrame frame{low - Point2::Constant(1.5 * kPresenceCell_m), kPresenceCell_m};
  const CellIndex last = frame.cell_of(high);
  Grid<std::uint8_t> grid(frame, last.i + 2, last.j + 2);
  for (const OrientedPoint& point : points) {
    const CellIndex cell = frame.cell_of(point.p);
    for (int dj = -1; dj <= 1; ++dj) {
      for (int di = -1; di <= 1; ++di) {
        grid[{cell.i + di, cell.j + dj}] = 1;
      }
    }
  }
  return grid;
}

}  // namespace

struct ReferenceCloud::Tree {
  using Index =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointAdaptor>, PointAdaptor, 2>;

  explicit Tree(const std::vector<OrientedPoint>& points)
      : adaptor{&points}, index(2, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize)) {}

  PointAdaptor adaptor;
  Index index;
};

ReferenceCloud::ReferenceCloud(std::vector<OrientedPoint> points_map)
    : points_(std::move(points_map)), presence_(presence_grid(points_)) {
  if (!points_.empty()) {
    tree_ = std::make_unique<Tree>(points_);
  }
}

ReferenceCloud::~ReferenceCloud() = default;

const OrientedPoint* ReferenceCloud::nearest(const Point2& p_map, double radius_m) const {
  if (!tree_) {
    return nullptr;
  }
  NearestWithin result(radius_m);
  tree_->index.findNeighbors(result, p_map.data(), nanoflann::SearchParams());
  const std::optional<std::uint32_t> index = result.index();
  return index ? &points_[*index] : nullptr;
}

}  // namespace seeker::slam
