#include "server/lab/search/search_figures.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>

#include "common/core/angle.hpp"
#include "common/image/plot.hpp"
#include "common/image/png.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/lab/plots/image_tools.hpp"
#include "server/options/world_options.hpp"
#include "server/search/fuzzy_rules.hpp"
#include "server/search/mamdani.hpp"
#include "server/vision/multi_recogniser.hpp"

namespace seeker::lab {
namespace {

constexpr int kPanelWidth_px = 900;
constexpr int kPanelHeight_px = 330;
constexpr int kSamples = 361;

using Membership = std::function<double(double)>;

image::Series sampled(const std::string& name, double low, double high, const Membership& membership) {
  image::Series series{.name = name, .x = {}, .y = {}};
  for (int i = 0; i < kSamples; ++i) {
    const double x = low + (high - low) * i / (kSamples - 1);
    series.x.push_back(x);
    series.y.push_back(membership(x));
  }
  return series;
}

Image panel(const std::string& title, const std::string& x_label, image::AxisRange x_range,
            std::vector<image::Series> series) {
  image::Chart chart;
  chart.title = title;
  chart.x_label = x_label;
  chart.y_label = "membership";
  chart.series = std::move(series);
  chart.x_range = x_range;
  chart.y_range = {0.0, 1.1};
  return image::draw_chart(chart, kPanelWidth_px, kPanelHeight_px);
}

constexpr std::array<const char*, search::kLevels> kTargetSets{"NB", "NS", "Z", "PS", "PB"};
constexpr std::array<const char*, search::kLevels> kHeadingChangeSets{"TNB", "TNS", "TZ", "TPS", "TPB"};

}  // namespace

Image membership_figure() {
  std::vector<image::Series> distance = {
      sampled("NEAR", 0.0, search::kMaxDistance_m, search::near_membership),
      sampled("FAR", 0.0, search::kMaxDistance_m, [](double d) { return 1.0 - search::near_membership(d); })};
  std::vector<image::Series> target;
  std::vector<image::Series> heading_change;
  for (std::size_t n = 0; n < search::kLevels; ++n) {
    const int level = static_cast<int>(n) - 2;
    target.push_back(sampled(kTargetSets[n], -180.0, 180.0,
                             [level](double deg) { return search::target_membership(level, deg_to_rad(deg)); }));
    heading_change.push_back(sampled(kHeadingChangeSets[n], -180.0, 180.0, [level](double deg) {
      return search::heading_change_membership(level, deg_to_rad(deg));
    }));
  }
  return contact_sheet(
      {{"",
        panel("Distance of an obstacle (L, LF, F, RF, R)", "m", {0.0, search::kMaxDistance_m}, std::move(distance))},
       {"", panel("Bearing of the target", "deg, left positive", {-180.0, 180.0}, std::move(target))},
       {"", panel("Change of heading", "deg, left positive", {-180.0, 180.0}, std::move(heading_change))}},
      1);
}

Result<Image> picture_of_target(const RunSpec& spec, double range_m, double bearing_rad) {
  const Result<app::RobotOptions> options = options_of(spec);
  if (!options) {
    return tl::unexpected<Error>(options.error());
  }
  Result<sim::World> world = options::load_world(spec.world_file);
  if (!world) {
    return tl::unexpected<Error>(world.error());
  }
  if (world->targets.empty()) {
    return fail(Errc::kInvalidArgument, spec.world_file.string() + ": has no target to take a picture of");
  }
  // In front of the target's face, looking so that the target appears under the bearing.
  const Pose2 target = world->targets.front().world_T_target;
  const Point2 place = target * Point2(range_m, 0.0);
  world->starts = {Pose2{place.x(), place.y(), wrap_angle(target.theta_rad + kPi - bearing_rad)}};
  Result<sim::Simulation> simulation = sim::Simulation::create(std::move(*world), options->sim.robot, spec.seed);
  if (!simulation) {
    return tl::unexpected<Error>(simulation.error());
  }
  return simulation->omni_image();
}

Result<Image> stages_figure(const RunSpec& spec, const std::filesystem::path& folder) {
  constexpr double kRange_m = 1.3;
  constexpr double kBearing_rad = 0.7;
  const Result<Image> picture = picture_of_target(spec, kRange_m, kBearing_rad);
  if (!picture) {
    return picture;
  }
  const Result<app::RobotOptions> options = options_of(spec);
  const Result<sim::World> world = options::load_world(spec.world_file);
  const Result<api::TargetSpec> target = target_of(*world, spec);
  if (!target) {
    return tl::unexpected<Error>(target.error());
  }
  const auto recogniser = vision::make_recogniser(
      {{.name = target->name, .picture = target->picture, .width_m = target->width_m, .height_m = target->height_m}},
      options->search.recogniser);
  if (!recogniser) {
    return tl::unexpected<Error>(recogniser.error());
  }
  const Result<std::vector<vision::StageImage>> stages = (*recogniser)->explain(*picture);
  if (!stages) {
    return tl::unexpected<Error>(stages.error());
  }
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  std::vector<CaptionedImage> sheet = {{"picture of the omnidirectional camera", *picture}};
  int number = 0;
  for (const vision::StageImage& stage : *stages) {
    std::array<char, 16> prefix{};
    std::snprintf(prefix.data(), prefix.size(), "%02d_", ++number);
    if (const Status ok = image::write_png(folder / (prefix.data() + stage.name + ".png"), stage.image); !ok) {
      return tl::unexpected<Error>(ok.error());
    }
    sheet.push_back({stage.name, stage.image});
  }
  constexpr int kColumns = 1;
  return contact_sheet(sheet, kColumns);
}

}  // namespace seeker::lab
