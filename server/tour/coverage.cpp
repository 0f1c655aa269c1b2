#include "server/tour/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <queue>
#include <string>
#include <tuple>
#include <utility>

#include "common/core/angle.hpp"
#include "server/nav/ray.hpp"

namespace seeker::tour {
namespace {

/// What is seen is noted in cells of this size.
constexpr double kNote_m = 0.1;
/// Neighbouring rays are so close that at the sensor's range none misses a cell.
constexpr int kRays = 720;
constexpr std::size_t kMostViews = 20000;

/// Cells that one viewpoint sees, by number: floor and wall of a cell have two numbers.
using Sights = std::vector<std::uint32_t>;

class Eye {
 public:
  Eye(const KnownBuilding& building, double range_m)
      : building_(building),
        range_cells_(range_m / building.free.frame().resolution_m),
        coarse_(std::max(1, static_cast<int>(std::lround(kNote_m / building.free.frame().resolution_m)))),
        width_((building.free.width() + coarse_ - 1) / coarse_),
        stamps_(2 * cells(), 0) {}

  [[nodiscard]] std::size_t numbers() const { return stamps_.size(); }
  [[nodiscard]] double cell_m() const { return coarse_ * building_.free.frame().resolution_m; }

  [[nodiscard]] Sights look(const Point2& from) {
    ++stamp_;
    Sights seen;
    const GridFrame& frame = building_.free.frame();
    const Point2 eye = (from - frame.origin) / frame.resolution_m;
    for (int k = 0; k < kRays; ++k) {
      const double angle_rad = kTwoPi * k / kRays;
      follow(eye, eye + range_cells_ * Point2(std::cos(angle_rad), std::sin(angle_rad)), seen);
    }
    return seen;
  }

 private:
  [[nodiscard]] std::size_t cells() const {
    const int height = (building_.free.height() + coarse_ - 1) / coarse_;
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height);
  }

  void follow(const Point2& from, const Point2& to, Sights& seen) {
    nav::RayWalk walk(from, to);
    do {
      const CellIndex cell = walk.cell();
      if (!building_.free.contains(cell)) {
        return;
      }
      if (building_.blocks[cell] != 0) {
        note(cell, 1, seen);
        return;
      }
      if (building_.free[cell] == 0) {
        return;
      }
      note(cell, 0, seen);
    } while (walk.advance());
  }

  void note(CellIndex cell, std::size_t wall, Sights& seen) {
    const auto coarse = static_cast<std::size_t>(cell.j / coarse_) * static_cast<std::size_t>(width_) +
                        static_cast<std::size_t>(cell.i / coarse_);
    const std::size_t number = 2 * coarse + wall;
    if (stamps_[number] != stamp_) {
      stamps_[number] = stamp_;
      seen.push_back(static_cast<std::uint32_t>(number));
    }
  }

  const KnownBuilding& building_;
  double range_cells_;
  int coarse_;
  int width_;
  std::vector<std::uint32_t> stamps_;  ///< number of the look that noted a cell last
  std::uint32_t stamp_ = 0;
};

bool is_wall(std::uint32_t number) { return number % 2 == 1; }

/// Numbers of floor and of wall cells.
struct Counts {
  double floor = 0.0;
  double wall = 0.0;
};

/// What has been seen of what can be seen, and by how many.
class Ledger {
 public:
  Ledger(std::size_t numbers, const std::vector<Sights>& sights) : seen_by_(numbers, 0) {
    std::vector<bool> any(numbers, false);
    for (const Sights& one : sights) {
      for (const std::uint32_t number : one) {
        if (!any[number]) {
          any[number] = true;
          count_of(all_, number) += 1.0;
        }
      }
    }
  }

  /// Sum of the shares of floor and walls that the sights would add.
  [[nodiscard]] double gain(const Sights& sights) const { return share_sum(seen_by_only(sights, 0)); }
  void add(const Sights& sights) {
    for (const std::uint32_t number : sights) {
      count_of(got_, number) += seen_by_[number]++ == 0 ? 1.0 : 0.0;
    }
  }
  void remove(const Sights& sights) {
    for (const std::uint32_t number : sights) {
      count_of(got_, number) -= --seen_by_[number] == 0 ? 1.0 : 0.0;
    }
  }
  /// Sum of the shares that nobody would see without the sights; nothing: too little would be left.
  [[nodiscard]] std::optional<double> loss(const Sights& sights, double share) const {
    const Counts lost = seen_by_only(sights, 1);
    const bool enough = got_.floor - lost.floor >= share * all_.floor && got_.wall - lost.wall >= share * all_.wall;
    return enough ? std::optional(share_sum(lost)) : std::nullopt;
  }
  [[nodiscard]] const Counts& all() const { return all_; }
  [[nodiscard]] double floor_share() const { return all_.floor > 0.0 ? std::min(1.0, got_.floor / all_.floor) : 1.0; }
  [[nodiscard]] double wall_share() const { return all_.wall > 0.0 ? std::min(1.0, got_.wall / all_.wall) : 1.0; }

 private:
  static double& count_of(Counts& counts, std::uint32_t number) { return is_wall(number) ? counts.wall : counts.floor; }
  [[nodiscard]] Counts seen_by_only(const Sights& sights, std::uint32_t by) const {
    Counts counts;
    for (const std::uint32_t number : sights) {
      count_of(counts, number) += seen_by_[number] == by ? 1.0 : 0.0;
    }
    return counts;
  }
  [[nodiscard]] double share_sum(const Counts& counts) const {
    return counts.floor / std::max(1.0, all_.floor) + counts.wall / std::max(1.0, all_.wall);
  }

  std::vector<std::uint32_t> seen_by_;
  Counts all_;
  Counts got_;
};

std::vector<Point2> candidates(const Grid<std::uint8_t>& drive, double step_m) {
  const int stride = std::max(1, static_cast<int>(std::lround(step_m / drive.frame().resolution_m)));
  std::vector<Point2> places;
  for (CellIndex cell{stride / 2, stride / 2}; cell.j < drive.height(); cell.j += stride) {
    for (cell.i = stride / 2; cell.i < drive.width(); cell.i += stride) {
      if (drive[cell] != 0) {
        places.push_back(drive.frame().centre_of(cell));
      }
    }
  }
  return places;
}

/// Takes the best viewpoint again and again. What a viewpoint adds only falls, so that old values order those that are
/// worth another look.
std::vector<std::size_t> choose(const std::vector<Sights>& sights, Ledger& ledger, double share) {
  using Entry = std::pair<double, std::size_t>;
  const auto worse = [](const Entry& a, const Entry& b) {
    return std::tie(a.first, b.second) < std::tie(b.first, a.second);
  };
  std::priority_queue<Entry, std::vector<Entry>, decltype(worse)> queue(worse);
  for (std::size_t k = 0; k < sights.size(); ++k) {
    queue.emplace(ledger.gain(sights[k]), k);
  }
  std::vector<std::size_t> chosen;
  while (!queue.empty() && (ledger.floor_share() < share || ledger.wall_share() < share)) {
    const std::size_t best = queue.top().second;
    queue.pop();
    const double gain = ledger.gain(sights[best]);
    if (!queue.empty() && gain < queue.top().first) {
      queue.emplace(gain, best);
      continue;
    }
    chosen.push_back(best);
    ledger.add(sights[best]);
  }
  return chosen;
}

/// Drops viewpoints that later ones made needless, those first that the least is lost without.
void prune(std::vector<std::size_t>& chosen, const std::vector<Sights>& sights, Ledger& ledger, double share) {
  while (true) {
    auto least = chosen.end();
    double least_loss = std::numeric_limits<double>::infinity();
    for (auto at = chosen.begin(); at != chosen.end(); ++at) {
      const std::optional<double> loss = ledger.loss(sights[*at], share);
      if (loss && *loss < least_loss) {
        least = at;
        least_loss = *loss;
      }
    }
    if (least == chosen.end()) {
      return;
    }
    ledger.remove(sights[*least]);
    chosen.erase(least);
  }
}

Status check(const KnownBuilding& building, const CoverageParams& params) {
  if (!(params.range_m > 0.0) || !(params.step_m > 0.0) || !(params.share > 0.0) || !(params.share <= 1.0)) {
    return fail(Errc::kInvalidArgument, "range and step must be above 0, and the share above 0 and at most 1");
  }
  const auto fits = [&](const Grid<std::uint8_t>& grid) {
    return grid.frame() == building.free.frame() && grid.width() == building.free.width() &&
           grid.height() == building.free.height();
  };
  if (building.free.empty() || !fits(building.blocks) || !fits(building.drive)) {
    return fail(Errc::kInvalidArgument, "the grids of a building must have one frame and one size");
  }
  return {};
}

}  // namespace

Result<Coverage> cover(const KnownBuilding& building, const std::vector<Point2>& already,
                       const CoverageParams& params) {
  if (const Status valid = check(building, params); !valid) {
    return tl::unexpected(valid.error());
  }
  const std::vector<Point2> places = candidates(building.drive, params.step_m);
  if (places.empty()) {
    return fail(Errc::kUnreachable, "there is no floor that the robot can drive on around the start");
  }
  if (places.size() > kMostViews) {
    return fail(Errc::kTooLarge, std::to_string(places.size()) + " viewpoints to try, at most " +
                                     std::to_string(kMostViews) + " are possible; ask for a larger step");
  }
  Eye eye(building, params.range_m);
  std::vector<Sights> sights;
  sights.reserve(places.size());
  for (const Point2& place : places) {
    sights.push_back(eye.look(place));
  }
  Ledger ledger(eye.numbers(), sights);
  for (const Point2& place : already) {
    ledger.add(eye.look(place));
  }
  std::vector<std::size_t> chosen = choose(sights, ledger, params.share);
  prune(chosen, sights, ledger, params.share);
  Coverage coverage;
  std::transform(chosen.begin(), chosen.end(), std::back_inserter(coverage.views),
                 [&](std::size_t k) { return places[k]; });
  coverage.floor_m2 = ledger.all().floor * eye.cell_m() * eye.cell_m();
  coverage.wall_m = ledger.all().wall * eye.cell_m();
  coverage.floor_share = ledger.floor_share();
  coverage.wall_share = ledger.wall_share();
  return coverage;
}

}  // namespace seeker::tour
