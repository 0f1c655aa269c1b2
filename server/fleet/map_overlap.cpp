#include "server/fleet/map_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include <Eigen/Eigenvalues>

#include "common/core/angle.hpp"

namespace seeker::fleet {
namespace {

/// What a says of a piece of wall that b has seen.
enum class Say : std::uint8_t { kDenied, kShared };

/// A cell of b's map, with the direction of its wall.
using CellKey = std::tuple<long, long, long>;

struct Tally {
  std::map<CellKey, std::pair<Say, Point2>> cells;  ///< with the normal, in the frame `map` of b
  double through = 0.0;                             ///< cells' worth of beams through walls
  double squares_m2 = 0.0;
  std::size_t pairs = 0;
  std::size_t witnesses = 0;
};

CellKey key_of(const slam::OrientedPoint& point, double cell_m) {
  constexpr double kDirections = 8.0;
  const double turn = std::atan2(point.normal.y(), point.normal.x()) / kTwoPi * kDirections;
  return {std::lround(point.p.x() / cell_m), std::lround(point.p.y() / cell_m),
          (std::lround(turn) + static_cast<long>(kDirections)) % static_cast<long>(kDirections)};
}

/// The partner of a point on the walls of a; null without one.
const slam::OrientedPoint* partner_of(const slam::PlaceMap& place, const slam::OrientedPoint& point,
                                      const OverlapParams& params) {
  const slam::OrientedPoint* nearest = place.cloud().nearest(point.p, params.partner_m);
  return nearest != nullptr && nearest->normal.dot(point.normal) >= params.min_normal_cosine ? nearest : nullptr;
}

Pose2 settled(const slam::PlaceMap& place, const std::vector<slam::OrientedPoint>& points, const Pose2& predicted,
              const OverlapParams& params) {
  slam::MatchParams match = params.match;
  match.first_gate_m = params.settle_m;
  const slam::MatchResult result =
      slam::ScanMatcher(match).match(place.cloud(), slam::thin_out(points, params.match_points), predicted);
  const bool near = distance_m(result.map_T_base, predicted) <= params.settle_m &&
                    std::abs(wrap_angle(result.map_T_base.theta_rad - predicted.theta_rad)) <= params.settle_rad;
  return near && result.pairs >= match.min_pairs ? result.map_T_base : predicted;
}

/// A node's scans with the origin in their middle.
struct Shown {
  Pose2 node_T_base;
  std::vector<slam::SeenPoints> seen;
  std::vector<slam::OrientedPoint> points;

  explicit Shown(const PreparedNode& node, double cell_m) : node_T_base{node.middle.x(), node.middle.y(), 0.0} {
    std::vector<slam::OrientedPoint> all;
    for (const slam::SeenPoints& scan : node.seen) {
      seen.push_back(slam::transform(inverse(node_T_base), scan));
      all.insert(all.end(), seen.back().points.begin(), seen.back().points.end());
    }
    points = slam::thin_by_cells(all, cell_m, std::numeric_limits<std::size_t>::max());
  }
};

/// Surroundings of a node in one of the two maps.
struct Around {
  std::shared_ptr<const slam::PlaceMap> place;
  Pose2 place_T_node;
};

Around around(PreparedMap& map, std::size_t region, const Pose2& map_T_node) {
  return {map.place(region), inverse(map.nodes()[map.regions()[region].node].map_T_node) * map_T_node};
}

/// A node of b in the map of a, and in its own.
void count(const Around& in_a, const Around& in_b, const PreparedNode& node, const OverlapParams& params,
           Tally& tally) {
  const slam::PlaceMap& place = *in_a.place;
  const Shown shown(node, params.cell_m);
  const Pose2 pose = settled(place, shown.points, in_a.place_T_node * shown.node_T_base, params);
  const Pose2 own_T_base = in_b.place_T_node * shown.node_T_base;
  const Pose2 map_T_base = node.map_T_node * shown.node_T_base;
  std::size_t shared = 0;
  std::size_t denied = 0;
  for (const slam::OrientedPoint& point_base : shown.points) {
    const slam::OrientedPoint point = slam::transform(pose, point_base);
    const slam::OrientedPoint* partner = partner_of(place, point, params);
    if (partner == nullptr &&
        (!place.free_space().is_free(point.p) || in_b.place->free_space().is_passed(own_T_base * point_base.p))) {
      continue;  // not observed, or no wall of b: b has looked through it as well
    }
    const slam::OrientedPoint own = slam::transform(map_T_base, point_base);
    auto& entry = tally.cells.try_emplace(key_of(own, params.cell_m), Say::kDenied, own.normal).first->second;
    denied += partner == nullptr ? 1 : 0;
    if (partner != nullptr) {
      entry.first = Say::kShared;
      const double off_m = partner->normal.dot(point.p - partner->p);
      tally.squares_m2 += off_m * off_m;
      ++tally.pairs;
      ++shared;
    }
  }
  if (shared + denied > 0) {
    const slam::Agreement agreement =
        slam::agreement_of(place.pyramid(), place.free_space(), shown.seen, pose, params.agreement);
    tally.through += agreement.through * static_cast<double>(shown.points.size());
  }
  tally.witnesses += params.cell_m * static_cast<double>(shared) >= params.witness_wall_m ? 1 : 0;
}

using Square = std::pair<long, long>;

/// Takes what is joined to `start` out of `open`.
std::vector<Square> take_piece(std::set<Square>& open, const Square& start, long reach) {
  std::vector<Square> piece{start};
  open.erase(start);
  for (std::size_t k = 0; k < piece.size(); ++k) {
    const Square from = piece[k];
    for (long dx = -reach; dx <= reach; ++dx) {
      for (long dy = -reach; dy <= reach; ++dy) {
        const Square next{from.first + dx, from.second + dy};
        if (open.erase(next) > 0) {
          piece.push_back(next);
        }
      }
    }
  }
  return piece;
}

/// The extent of a piece along its principal axis, in squares. The number of squares would call a heap of chairs a long
/// wall.
double length_of(const std::vector<Square>& piece) {
  Eigen::Matrix2Xd centres(2, static_cast<Eigen::Index>(piece.size()));
  for (std::size_t k = 0; k < piece.size(); ++k) {
    centres.col(static_cast<Eigen::Index>(k)) =
        Point2(static_cast<double>(piece[k].first), static_cast<double>(piece[k].second));
  }
  const Eigen::Matrix2Xd offsets = centres.colwise() - centres.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Matrix2> eigen(offsets * offsets.transpose());
  const Eigen::RowVectorXd along = eigen.eigenvectors().col(1).transpose() * offsets;
  return along.maxCoeff() - along.minCoeff() + 1.0;
}

double longest_denied_m(const Tally& tally, const OverlapParams& params) {
  std::set<Square> open;
  for (const auto& [key, cell] : tally.cells) {
    if (cell.first == Say::kDenied) {
      open.emplace(std::get<0>(key), std::get<1>(key));
    }
  }
  const long reach = std::max(1L, std::lround(params.piece_gap_m / params.cell_m));
  double longest = 0.0;
  while (!open.empty()) {
    const std::vector<Square> piece = take_piece(open, *open.begin(), reach);
    longest = std::max(longest, length_of(piece));
  }
  return params.cell_m * longest;
}

MapOverlap summary_of(const Tally& tally, const OverlapParams& params) {
  MapOverlap overlap;
  Matrix2 scatter = Matrix2::Zero();
  double shared = 0.0;
  for (const auto& [key, cell] : tally.cells) {
    if (cell.first == Say::kShared) {
      scatter += cell.second * cell.second.transpose();
      shared += 1.0;
    }
  }
  const Eigen::SelfAdjointEigenSolver<Matrix2> eigen(scatter, Eigen::EigenvaluesOnly);
  overlap.shared_wall_m = params.cell_m * shared;
  overlap.weak_wall_m = params.cell_m * eigen.eigenvalues()[0];
  const double known = static_cast<double>(tally.cells.size()) + tally.through;
  overlap.contradiction = known > 0.0 ? (known - shared) / known : 0.0;
  overlap.denied_piece_m = longest_denied_m(tally, params);
  overlap.residual_m = tally.pairs > 0 ? std::sqrt(tally.squares_m2 / static_cast<double>(tally.pairs)) : 0.0;
  overlap.witnesses = tally.witnesses;
  return overlap;
}

}  // namespace

MapOverlap overlap_of(PreparedMap& a, PreparedMap& b,
                      const std::function<std::optional<Pose2>(std::size_t)>& map_a_T_node,
                      const OverlapParams& params) {
  Tally tally;
  for (std::size_t k = 0; k < b.nodes().size(); ++k) {
    const PreparedNode& node = b.nodes()[k];
    const std::optional<Pose2> pose = map_a_T_node(k);
    const std::optional<std::size_t> region = pose ? a.region_at(*pose * node.middle) : std::nullopt;
    const Around in_a = region ? around(a, *region, *pose) : Around{};
    const Around in_b = in_a.place ? around(b, node.region, node.map_T_node) : Around{};
    if (in_b.place) {
      count(in_a, in_b, node, params, tally);
    }
  }
  return summary_of(tally, params);
}

}  // namespace seeker::fleet
