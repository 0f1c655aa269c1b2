#include "server/lab/line_detection/line_sensitivity.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/drivers/replay/replay.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/line_detection/reproduce_line_detection.hpp"
#include "server/lines/make_extractor.hpp"
#include "server/sim/range_sensors.hpp"

namespace seeker::lab {
namespace {

constexpr std::array kFactors{0.5, 0.7, 0.85, 1.2, 1.4, 2.0};
constexpr double kKept_m = 0.005;
constexpr double kKept_rad = deg_to_rad(0.5);

sim::LidarModel rplidar() {
  sim::LidarModel model;
  model.beams = 360;
  model.angle_min_rad = -kPi;
  model.angle_step_rad = kTwoPi / 360.0;
  model.range_min_m = 0.15;
  model.range_max_m = 6.0;
  model.sigma_range_m = 0.003;
  model.sigma_relative = 0.005;
  model.quality_max = 47;
  return model;
}

/// The three detectors whose thresholds are scaled.
enum class Detector : std::uint8_t { kPrinted, kOurs, kSplitAndMerge };

lines::ExtractorParams scaled(Detector detector, double factor) {
  lines::ExtractorParams params;
  params.kind =
      detector == Detector::kSplitAndMerge ? lines::ExtractorKind::kSplitAndMerge : lines::ExtractorKind::kFiveModes;
  if (detector == Detector::kPrinted) {
    params.five_modes.fit_error_sigmas = 0.0;
    params.five_modes.corner_sigmas = 0.0;
  }
  params.five_modes.start = {factor * params.five_modes.start.gap_m, factor * params.five_modes.start.corner_m};
  params.split.gap_m *= factor;
  params.split.split_m *= factor;
  return params;
}

bool is_same(const lines::Line& a, const lines::Line& b) {
  return std::abs(a.r_m - b.r_m) <= kKept_m && std::abs(wrap_angle(a.alpha_rad - b.alpha_rad)) <= kKept_rad;
}

struct Kept {
  std::size_t lines = 0;
  std::size_t kept = 0;

  [[nodiscard]] double lost_share() const {
    return lines > 0 ? 1.0 - static_cast<double>(kept) / static_cast<double>(lines) : 0.0;
  }
};

Kept compare_factor(const std::vector<LaserScan>& scans, Detector detector, double factor) {
  const auto reference = lines::make_extractor(scaled(detector, 1.0));
  const auto changed = lines::make_extractor(scaled(detector, factor));
  Kept result;
  for (const LaserScan& scan : scans) {
    const lines::ScanLines before = reference->extract(scan);
    const lines::ScanLines after = changed->extract(scan);
    result.lines += before.lines.size();
    result.kept +=
        static_cast<std::size_t>(std::count_if(before.lines.begin(), before.lines.end(), [&](const lines::Line& line) {
          return std::any_of(after.lines.begin(), after.lines.end(),
                             [&](const lines::Line& other) { return is_same(line, other); });
        }));
  }
  return result;
}

}  // namespace

LaserScan scene_scan(std::uint64_t seed) {
  Rng rng(seed);
  sim::World world;
  const Point2 half(rng.uniform(1.5, 4.0), rng.uniform(1.5, 4.0));
  world.min_corner = -half;
  world.max_corner = half;
  const std::array corners{Point2(-half.x(), -half.y()), Point2(half.x(), -half.y()), Point2(half.x(), half.y()),
                           Point2(-half.x(), half.y())};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    sim::Wall wall;
    wall.a = corners[k];
    wall.b = corners[(k + 1) % corners.size()];
    world.walls.push_back(wall);
  }
  constexpr int kBoxes = 4;
  for (int k = 0; k < kBoxes; ++k) {
    // Along the walls, so that the middle stays free for the scanner.
    const bool aside = rng.uniform() < 0.5;
    const double share = rng.uniform(0.7, 0.9) * (rng.uniform() < 0.5 ? -1.0 : 1.0);
    const double along = rng.uniform(-0.7, 0.7);
    sim::Box box;
    box.world_T_box = {half.x() * (aside ? share : along), half.y() * (aside ? along : share), rng.uniform(-0.6, 0.6)};
    box.length_m = rng.uniform(0.3, 1.0);
    box.width_m = rng.uniform(0.2, 0.6);
    world.boxes.push_back(box);
  }
  const Pose2 world_T_base{rng.uniform(-0.3, 0.3) * half.x(), rng.uniform(-0.3, 0.3) * half.y(),
                           rng.uniform(-kPi, kPi)};
  return sim::sweep(rplidar(), sim::Scene(world), world_T_base, RobotTime{}, rng);
}

Result<std::vector<LaserScan>> scans_of_log(const std::filesystem::path& log, const std::filesystem::path& robot_file,
                                            std::size_t step) {
  const Result<app::RobotOptions> options = app::load_robot_options(robot_file);
  if (!options) {
    return tl::unexpected<Error>(options.error());
  }
  const auto source = drivers::ReplaySource::open(log, options->replay.params);
  if (!source) {
    return tl::unexpected<Error>(source.error());
  }
  std::vector<LaserScan> scans;
  std::size_t number = 0;
  while ((*source)->advance_one()) {
    std::optional<LaserScan> scan = (*source)->take_scan();
    if (scan && number++ % step == 0) {
      scans.push_back(std::move(*scan));
    }
  }
  return scans;
}

std::string check_sensitivity(const std::string& name, const std::vector<LaserScan>& scans, Report& report) {
  Table table({"scans", "factor", "printed_lines", "printed_lost", "ours_lines", "ours_lost", "split_and_merge_lines",
               "split_and_merge_lost"});
  constexpr std::array kDetectors{Detector::kPrinted, Detector::kOurs, Detector::kSplitAndMerge};
  std::array<Kept, kDetectors.size()> all;
  for (const double factor : kFactors) {
    std::vector<std::string> row{name, fixed(factor, 2)};
    for (std::size_t d = 0; d < kDetectors.size(); ++d) {
      const Kept one = compare_factor(scans, kDetectors[d], factor);
      all[d].lines += one.lines;
      all[d].kept += one.kept;
      row.push_back(std::to_string(one.lines));
      row.push_back(fixed(one.lost_share(), 3));
    }
    table.add(std::move(row));
  }
  const double split_share = all[2].lost_share();
  for (const std::size_t d : {std::size_t{0}, std::size_t{1}}) {
    report.add({.id = "R10",
                .passed = all[d].lost_share() < split_share,
                .figures = {{"scans", name},
                            {"count", std::to_string(scans.size())},
                            {"thresholds", "x0.5..x2"},
                            {"detector", d == 0 ? "printed" : "ours"},
                            {"lines_changed", fixed(all[d].lost_share(), 3)},
                            {"split_and_merge_changed", fixed(split_share, 3)}},
                .finding = d == 0});
  }
  return table.csv();
}

}  // namespace seeker::lab
