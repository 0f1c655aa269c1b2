#include "server/lab/search/hit_rate_study.hpp"

#include <algorithm>
#include <cmath>

#include "common/config/yaml.hpp"
#include "common/core/angle.hpp"
#include "common/image/plot.hpp"
#include "server/app/missions/target_values.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/options/search_options.hpp"
#include "server/options/world_options.hpp"
#include "server/sim/placement.hpp"
#include "server/vision/solids/target_recogniser.hpp"

namespace seeker::lab {
namespace {

constexpr double kTargetRadius_m = 0.25;     ///< a laser beam that ends so near to the target's centre hits it
constexpr double kLargestHeading_rad = 1.4;  ///< the laser must see the target: it covers +-90 deg
constexpr double kLeastRate = 0.1;

/// Whether the newest sweep reaches the target.
bool in_view(const LaserScan& scan, double bearing_rad, double range_m) {
  const double beam = (bearing_rad - scan.angle_min_rad) / scan.angle_step_rad;
  const auto index = static_cast<std::ptrdiff_t>(std::lround(beam));
  if (index < 0 || index >= static_cast<std::ptrdiff_t>(scan.ranges_m.size())) {
    return false;
  }
  const double seen_m = scan.ranges_m[static_cast<std::size_t>(index)];
  return std::isfinite(seen_m) && std::abs(seen_m - range_m) < kTargetRadius_m;
}

/// The world with the target, and the largest angle between the target and straight ahead.
struct Subject {
  sim::World world;
  Point2 place = Point2::Zero();
  double largest_heading_rad = kLargestHeading_rad;
};

Result<Subject> place_solid(const sim::World& world, SolidKind kind, double largest_heading_rad, Rng& rng) {
  const auto found = std::find_if(world.solids.begin(), world.solids.end(),
                                  [kind](const sim::TankSolid& solid) { return solid.shape == kind; });
  if (found == world.solids.end()) {
    return fail(Errc::kNotFound, "world '" + world.name + "' has no " + std::string(to_string(kind)));
  }
  constexpr double kFromWall_m = 0.6;
  const Point2 low = world.min_corner.array() + kFromWall_m;
  const Point2 high = world.max_corner.array() - kFromWall_m;
  Subject subject{world, Point2(rng.uniform(low.x(), high.x()), rng.uniform(low.y(), high.y())), largest_heading_rad};
  sim::TankSolid solid = *found;
  solid.world_T_solid = {subject.place.x(), subject.place.y(), rng.uniform(-kPi, kPi)};
  subject.world.solids = {solid};
  return subject;
}

Result<Subject> place_subject(const sim::World& world, const app::RobotOptions& options, const HitRateParams& params,
                              Rng& rng) {
  if (params.solid) {
    const int pictures = app::pictures_around(options.search.recogniser.view, options.search.round);
    return place_solid(world, *params.solid, kPi / pictures, rng);
  }
  Subject subject{world};
  const Result<Pose2> pose = sim::place_target(subject.world, 0, rng);
  if (!pose) {
    return tl::unexpected<Error>(pose.error());
  }
  subject.place = pose->translation();
  return subject;
}

Result<std::unique_ptr<vision::Recogniser>> make_recogniser(const app::RobotOptions& options,
                                                            const api::TargetSpec& target) {
  const Result<std::shared_ptr<const vision::SolidModel>> solids = app::load_solids(options);
  if (!solids) {
    return tl::unexpected<Error>(solids.error());
  }
  return vision::make_target_recogniser(app::target_models({target}), options.search.recogniser, solids->get());
}

/// One picture counted into its bin, when it can be taken.
Status take_picture(const Subject& subject, const app::RobotOptions& options, const vision::Recogniser& recogniser,
                    const HitRateParams& params, Rng& rng, HitRateBin& bin) {
  const Point2 target = subject.place;
  const double direction_rad = rng.uniform(-kPi, kPi);
  const double heading_offset_rad = rng.uniform(-subject.largest_heading_rad, subject.largest_heading_rad);
  const Point2 place = target + bin.range_m * Point2(std::cos(direction_rad), std::sin(direction_rad));
  sim::World placed = subject.world;
  placed.starts = {Pose2{place.x(), place.y(), wrap_angle(direction_rad + kPi - heading_offset_rad)}};
  Result<sim::Simulation> simulation = sim::Simulation::create(std::move(placed), options.sim.robot, rng.bits());
  if (!simulation) {
    return {};  // no room for the robot there
  }
  if (!in_view(simulation->scan(), heading_offset_rad, bin.range_m)) {
    return {};
  }
  const Result<vision::RecognitionReport> report = recogniser.recognise(simulation->camera_image());
  if (!report) {
    return tl::unexpected<Error>(report.error());
  }
  ++bin.pictures;
  bool hit = false;
  for (const vision::Sighting& sighting : report->sightings) {
    const double off_deg = rad_to_deg(std::abs(wrap_angle(sighting.bearing_base_rad - heading_offset_rad)));
    // From near the recognised face lies beside the target's middle by as much as its half.
    const double extent_deg = rad_to_deg(std::atan(kTargetRadius_m / bin.range_m));
    const bool near = off_deg <= std::max(params.bearing_gate_deg, extent_deg);
    hit = hit || near;
    bin.false_sightings += near ? 0 : 1;
  }
  bin.hits += hit ? 1 : 0;
  return {};
}

double log_likelihood(const std::vector<HitRateBin>& bins, double size_m, const search::HitRate& rate) {
  constexpr double kLeast = 1e-4;
  double sum = 0.0;
  for (const HitRateBin& bin : bins) {
    const double p = std::clamp(rate.probability(bin.range_m, size_m), kLeast, 1.0 - kLeast);
    sum += bin.hits * std::log(p) + (bin.pictures - bin.hits) * std::log(1.0 - p);
  }
  return sum;
}

}  // namespace

Result<api::TargetSpec> studied_target(const sim::World& world, const HitRateParams& params) {
  return params.solid ? api::solid_target(*params.solid) : target_of(world, params.spec);
}

Result<std::vector<HitRateBin>> measure_hit_rate(const HitRateParams& params) {
  const Result<app::RobotOptions> options = options_of(params.spec);
  if (!options) {
    return tl::unexpected<Error>(options.error());
  }
  const Result<sim::World> world = options::load_world(params.spec.world_file);
  if (!world) {
    return tl::unexpected<Error>(world.error());
  }
  const Result<api::TargetSpec> target = studied_target(*world, params);
  if (!target) {
    return tl::unexpected<Error>(target.error());
  }
  const Result<std::unique_ptr<vision::Recogniser>> recogniser = make_recogniser(*options, *target);
  if (!recogniser) {
    return tl::unexpected<Error>(recogniser.error());
  }
  std::vector<HitRateBin> bins;
  for (double range_m = params.range_min_m; range_m <= params.range_max_m + 1e-9; range_m += params.range_step_m) {
    bins.push_back({.range_m = range_m});
  }
  for (const std::uint64_t seed : params.seeds) {
    Rng rng(seed);
    const Result<Subject> subject = place_subject(*world, *options, params, rng);
    if (!subject) {
      return tl::unexpected<Error>(subject.error());
    }
    for (HitRateBin& bin : bins) {
      for (int n = 0; n < params.directions; ++n) {
        if (const Status ok = take_picture(*subject, *options, **recogniser, params, rng, bin); !ok) {
          return tl::unexpected<Error>(ok.error());
        }
      }
    }
  }
  return bins;
}

search::HitRate fit_hit_rate(const std::vector<HitRateBin>& bins, double size_m, const search::HitRate& camera) {
  search::HitRate fit = camera;
  fit.max_range_m = fit.min_range_m = 0.0;
  for (const HitRateBin& bin : bins) {
    if (bin.pictures > 0 && bin.rate() >= kLeastRate) {
      fit.min_range_m = fit.max_range_m > 0.0 ? fit.min_range_m : bin.range_m;
      fit.max_range_m = bin.range_m;
    }
  }
  search::HitRate best = fit;
  double best_likelihood = -1e300;
  // Three bounded parameters and a smooth function: a grid is sure and fast enough.
  for (int b = 50; b <= 99; ++b) {
    fit.best = b / 100.0;
    for (int h = 2; h <= 60; ++h) {
      fit.half_size_px = h / 2.0;
      for (int s = 1; s <= 20; ++s) {
        fit.size_slope_px = s / 4.0;
        const double likelihood = log_likelihood(bins, size_m, fit);
        if (likelihood > best_likelihood) {
          best_likelihood = likelihood;
          best = fit;
        }
      }
    }
  }
  return best;
}

std::string hit_rate_csv(const std::vector<HitRateBin>& bins, double size_m, const search::HitRate& fit) {
  Table table({"range_m", "pictures", "hits", "false_sightings", "rate", "fitted"});
  for (const HitRateBin& bin : bins) {
    table.add({fixed(bin.range_m, 2), std::to_string(bin.pictures), std::to_string(bin.hits),
               std::to_string(bin.false_sightings), bin.pictures > 0 ? fixed(bin.rate(), 3) : "",
               fixed(fit.probability(bin.range_m, size_m), 3)});
  }
  return table.csv();
}

std::string hit_rate_yaml(const search::HitRate& fit) {
  std::string text = "search:\n  coverage:\n    hit_rate:\n";
  std::string fields = config::print(fit);
  for (std::size_t begin = 0; begin < fields.size();) {
    const std::size_t end = fields.find('\n', begin);
    text += "      " + fields.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  return text;
}

Image hit_rate_chart(const std::vector<HitRateBin>& bins, double size_m, const search::HitRate& fit,
                     const search::HitRate& before) {
  image::Series measured{.name = "measured", .x = {}, .y = {}, .style = image::SeriesStyle::kPoints};
  image::Series fitted{.name = "fitted", .x = {}, .y = {}};
  image::Series used{.name = "in the robot file", .x = {}, .y = {}, .line = image::LineStyle::kDashed};
  for (const HitRateBin& bin : bins) {
    if (bin.pictures > 0) {
      measured.x.push_back(bin.range_m);
      measured.y.push_back(bin.rate());
    }
  }
  constexpr double kStep_m = 0.02;
  for (double range_m = 0.0; range_m <= bins.back().range_m; range_m += kStep_m) {
    fitted.x.push_back(range_m);
    fitted.y.push_back(fit.probability(range_m, size_m));
    used.x.push_back(range_m);
    used.y.push_back(before.probability(range_m, size_m));
  }
  image::Chart chart;
  chart.title = "Hit rate of the recogniser in the simulator";
  chart.x_label = "range, m";
  chart.y_label = "share of pictures with the target found";
  chart.series = {measured, fitted, used};
  chart.y_range = {0.0, 1.0};
  return image::draw_chart(chart);
}

}  // namespace seeker::lab
