#include "server/lab/stereo_database/stereo_bisection.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "common/core/angle.hpp"
#include "server/lab/experiments/sim_run.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/stereo_database/stereo_parts.hpp"

namespace seeker::lab {

void describe(config::Fields& f, BisectionRow& row) {
  f.field("name", row.name);
  f.field("landmarks", row.landmarks);
  f.field("all_rms_m", row.all_rms_m);
  f.field("salient_rms_m", row.salient_rms_m);
  f.field("salient_rms_rad", row.salient_rms_rad);
  f.field("mean_inliers", row.mean_inliers);
}

void describe(config::Fields& f, BisectionResult& result) {
  f.field("schema", result.schema);
  f.field("seed", result.seed);
  f.field("settings", result.settings);
  f.list("rows", result.rows);
}

const std::vector<PrintedChoice>& printed_choices() {
  static const std::vector<PrintedChoice> kChoices = {
      {"gates",
       {"stereo.features.match.scale_gate_kind=ratio", "stereo.features.match.paper_uniqueness=false",
        "stereo.features.match.min_disparity_px=4"}},
      {"disparity_limit",
       {"stereo.features.match.max_disparity_px=200", "stereo.database.range.min_m=0.6",
        "stereo.localiser.range.min_m=0.6"}},
      {"descriptor",
       {"stereo.features.detector.descriptor=root_sift", "stereo.features.match.metric=l2",
        "stereo.features.match.max_distance=0.43", "stereo.database.association.metric=l2",
        "stereo.database.association.max_distance=0.5", "stereo.database.sparsity.min_distance=0.7",
        "stereo.localiser.metric=l2", "stereo.localiser.tracking.max_distance=0.5",
        "stereo.localiser.relocalise.max_distance=0.45"}},
      {"subpixel", {"stereo.features.match.refine_disparity=true"}},
      {"search",
       {"stereo.features.match.bbf_leaves=0", "stereo.database.association.bbf_leaves=0",
        "stereo.localiser.bbf_leaves=0"}},
      {"bundle_adjustment", {"stereo.database.adjustment.on=true"}},
      {"database",
       {"stereo.database.noise.separate_eyes=false", "stereo.database.association.anywhere=false",
        "stereo.database.fusion.running_mean=false", "stereo.database.sparsity.best_first=true",
        "stereo.database.sparsity.inner_radius_m=0.05", "stereo.database.sparsity.outer_radius_m=0.2"}},
      {"filter",
       {"stereo.localiser.mode=joint", "stereo.localiser.noise.separate_eyes=false",
        "stereo.localiser.measurement.range_floor_m=0.01",
        "stereo.localiser.measurement.bearing_floor_deg=0.0572957795",
        "stereo.localiser.measurement.landmark_covariance=true", "stereo.localiser.disparity_offset_sigma_px=0.2",
        "stereo.localiser.disparity_offset_walk_px=0.005", "stereo.localiser.map_sigma_m=0.003",
        "stereo.localiser.map_sigma_deg=0.06", "stereo.localiser.tracking.gate_chi2=18.421",
        "stereo.localiser.relocalise.guess_inliers=5"}}};
  return kChoices;
}

namespace {

constexpr double kFramePeriod_s = 2.0;

SimSpec sim_spec_of(const StereoSpec& spec, bool paper, const std::vector<std::string>& overrides) {
  SimSpec sim;
  sim.robot_file = spec.config / "robots" / (paper ? "paper/stereo-2017.yaml" : "stereo.yaml");
  sim.world_file = spec.config / "worlds" / "laboratory.yaml";
  sim.seed = spec.seed;
  sim.overrides = spec.overrides;
  sim.overrides.insert(sim.overrides.end(), overrides.begin(), overrides.end());
  return sim;
}

/// Pictures of one seed, taken once for all robots, and the features of the newest parameters.
class Bisection {
 public:
  Bisection(const sim::World& world, const sim::RobotModel& model, std::uint64_t seed)
      : world_(world), model_(model), seed_(seed) {}

  Status photograph();
  Result<BisectionRow> run(const std::string& name, const stereo::Bench& bench);

 private:
  Status observe(const vision::StereoFeatureParams& params);
  Result<DatabaseScore> localise(const stereo::Bench& bench, const std::vector<localize::Sighting>& views,
                                 bool salient) const;

  const sim::World& world_;
  const sim::RobotModel& model_;
  std::uint64_t seed_;
  stereo::SurveyPictures pictures_;
  Rng rng_{0};  ///< as it was after the pictures of the survey
  stereo::Frames frames_;
  std::vector<StereoFrame> drive_pairs_;
  std::optional<vision::StereoFeatureParams> observed_by_;
  std::vector<vision::StereoFeatures> survey_seen_;
};

Status Bisection::photograph() {
  rng_ = Rng(seed_).fork("survey");
  pictures_ = stereo::photograph_survey(world_, model_, rng_);
  Result<stereo::Frames> frames = photograph_drive(world_, model_, seed_, kFramePeriod_s);
  if (!frames) {
    return tl::unexpected<Error>(frames.error());
  }
  frames_ = std::move(*frames);
  for (DriveFrame& frame : frames_) {
    drive_pairs_.push_back(std::exchange(frame.pair, {}));
  }
  return {};
}

Status Bisection::observe(const vision::StereoFeatureParams& params) {
  if (observed_by_ == params) {
    return {};
  }
  Result<std::vector<vision::StereoFeatures>> survey = features_of(pictures_.pairs, model_, params);
  Result<std::vector<vision::StereoFeatures>> drive = features_of(drive_pairs_, model_, params);
  for (const auto* seen : {&survey, &drive}) {
    if (!*seen) {
      return tl::unexpected<Error>(seen->error());
    }
  }
  survey_seen_ = std::move(*survey);
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    frames_[i].seen = std::move((*drive)[i]);
  }
  observed_by_ = params;
  return {};
}

Result<DatabaseScore> Bisection::localise(const stereo::Bench& bench, const std::vector<localize::Sighting>& views,
                                          bool salient) const {
  const Result<stereo::Built> built = stereo::build(bench, views, salient, salient);
  if (!built) {
    return tl::unexpected<Error>(built.error());
  }
  stereo::Localisation localisation(bench, salient ? "salient" : "all", built->database, kFramePeriod_s);
  if (const Status ok = localisation.run(frames_, seed_, nullptr); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return localisation.score();
}

Result<BisectionRow> Bisection::run(const std::string& name, const stereo::Bench& bench) {
  if (const Status ok = observe(bench.features); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  Rng rng = rng_;
  const auto views = stereo::survey_views(bench, pictures_.world_T_eyes, survey_seen_, rng);
  if (!views) {
    return tl::unexpected<Error>(views.error());
  }
  const Result<DatabaseScore> all = localise(bench, *views, false);
  const Result<DatabaseScore> salient = localise(bench, *views, true);
  for (const auto* score : {&all, &salient}) {
    if (!*score) {
      return tl::unexpected<Error>(score->error());
    }
  }
  return BisectionRow{name, salient->landmarks, all->rms_m, salient->rms_m, salient->rms_rad, salient->mean_inliers};
}

/// The robot as printed, and those with one choice as ours.
std::vector<PrintedChoice> robots() {
  std::vector<PrintedChoice> robots = {{"printed", {}}};
  robots.insert(robots.end(), printed_choices().begin(), printed_choices().end());
  return robots;
}

}  // namespace

Result<std::string> bisection_settings_of(const StereoSpec& spec) {
  const SimSpec sim = sim_spec_of(spec, true, {});
  Result<TextHash> hash = settings_hash(sim_options(sim), sim);
  if (!hash) {
    return tl::unexpected<Error>(hash.error());
  }
  for (const PrintedChoice& choice : printed_choices()) {
    for (const std::string& field : choice.as_ours) {
      hash->add(field);
    }
  }
  return hash->hex();
}

Result<BisectionResult> bisect_stereo(const StereoSpec& spec) {
  Result<sim::World> world = load_laboratory(spec.config, spec.seed);
  const Result<app::RobotOptions> printed = sim_options(sim_spec_of(spec, true, {}));
  if (!world || !printed) {
    return tl::unexpected<Error>(!world ? world.error() : printed.error());
  }
  Bisection bisection(*world, printed->sim.robot, spec.seed);
  if (const Status ok = bisection.photograph(); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  BisectionResult result;
  result.seed = spec.seed;
  std::vector<std::pair<std::string, SimSpec>> specs;
  for (const PrintedChoice& robot : robots()) {
    specs.emplace_back(robot.name, sim_spec_of(spec, true, robot.as_ours));
  }
  specs.emplace_back("ours", sim_spec_of(spec, false, {}));
  for (const auto& [name, sim] : specs) {
    const Result<app::RobotOptions> options = sim_options(sim);
    if (!options) {
      return tl::unexpected<Error>(options.error());
    }
    Result<BisectionRow> row = bisection.run(name, stereo::bench_of(*options));
    if (!row) {
      return fail_with_context("bisection: " + name, row.error());
    }
    result.rows.push_back(std::move(*row));
  }
  return result;
}

std::string bisection_csv(const std::vector<BisectionResult>& results) {
  Table table({"seed", "as_ours", "landmarks", "all_rms_mm", "salient_rms_mm", "salient_rms_deg", "mean_inliers"});
  for (const BisectionResult& result : results) {
    for (const BisectionRow& row : result.rows) {
      table.add({std::to_string(result.seed), row.name, std::to_string(row.landmarks), fixed(1000.0 * row.all_rms_m, 1),
                 fixed(1000.0 * row.salient_rms_m, 1), fixed(rad_to_deg(row.salient_rms_rad), 3),
                 fixed(row.mean_inliers, 1)});
    }
  }
  return table.csv();
}

}  // namespace seeker::lab
