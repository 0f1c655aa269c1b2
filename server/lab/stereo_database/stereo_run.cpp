#include "server/lab/stereo_database/stereo_run.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include "server/lab/experiments/sim_run.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/stereo_database/stereo_notes.hpp"
#include "server/lab/stereo_database/stereo_parts.hpp"
#include "server/lab/stereo_database/stereo_places.hpp"
#include "server/localize/database_update.hpp"
#include "server/sim/rearrange.hpp"

namespace seeker::lab {
namespace {

using localize::LandmarkDatabase;
using Database = stereo::Database;
using Frames = stereo::Frames;
using stereo::Bench;
using stereo::Localisation;

constexpr double kMovedShare = 0.2;
/// A room that was never surveyed has other walls, all its furniture elsewhere, and other textures. In the surveyed
/// room with other textures and half of its furniture moved, the frames of bookcases and posters gave the right place
/// in 4 of 100 views: that is the same room with new paint.
constexpr double kForeignShare = 1.0;
/// The least and the most that it is longer, and narrower.
constexpr std::array<double, 2> kForeignLonger = {1.05, 1.2};
constexpr std::array<double, 2> kForeignNarrower = {0.8, 0.95};
constexpr int kPlaces = 20;         ///< at which a robot wakes up; 200 over ten seeds
constexpr int kForeignViews = 100;  ///< 1000 over ten seeds
constexpr int kSmallestPlaces = 2;
constexpr int kSmallestForeignViews = 5;
constexpr std::uint64_t kForeignTextures = 100'000;

SimSpec sim_spec_of(const StereoSpec& spec) {
  SimSpec sim;
  sim.robot_file = spec.config / "robots" / (spec.paper ? "paper/stereo-2017.yaml" : "stereo.yaml");
  sim.world_file = spec.config / "worlds" / "laboratory.yaml";
  sim.seed = spec.seed;
  sim.overrides = spec.overrides;
  return sim;
}

/// The whole of one seed, step by step.
class StereoRun {
 public:
  StereoRun(const StereoSpec& spec, const Bench& bench, sim::World world)
      : spec_(spec), bench_(bench), world_(std::move(world)), rng_(spec.seed) {}

  Status survey_and_drive();
  Status change_and_update();
  Status relocalise();
  StereoRecord take() { return std::move(record_); }

 private:
  Status survey();
  Result<Frames> drive(const sim::World& world, std::uint64_t seed) const;
  Status localise(const std::string& name, const Database& database, const Frames& frames,
                  localize::DatabaseUpdate* update);
  Status wake_up();
  Status observe_foreign();

  const StereoSpec& spec_;
  const Bench& bench_;
  sim::World world_;
  Rng rng_;
  Database salient_;
  std::vector<localize::Sighting> views_;          ///< of the survey
  std::vector<Image> shown_;                       ///< pictures of stereo::kShownViews
  std::vector<std::vector<std::size_t>> matched_;  ///< of the newest drive: features of each frame that were matched
  StereoRecord record_;
  std::vector<double> relocalise_ms_;
};

Status StereoRun::localise(const std::string& name, const Database& database, const Frames& frames,
                           localize::DatabaseUpdate* update) {
  Localisation localisation(bench_, name, database, stereo::frame_period_s(spec_));
  if (Status ok = localisation.run(frames, spec_.seed, update); !ok) {
    return ok;
  }
  matched_ = localisation.matched();
  record_.result.scores.push_back(localisation.score());
  record_.result.scores.back().inside = stereo::share_inside(*database, world_);
  record_.curves.push_back(localisation.curve());
  DatabasePlan plan{name, {}};
  for (const localize::Landmark& landmark : database->landmarks()) {
    plan.landmarks.emplace_back(landmark.p_map.head<2>());
  }
  record_.plans.push_back(std::move(plan));
  return {};
}

Result<Frames> StereoRun::drive(const sim::World& world, std::uint64_t seed) const {
  return drive_around(world, bench_.model, bench_.features, seed, stereo::frame_period_s(spec_));
}

Status StereoRun::survey() {
  Rng rng = rng_.fork("survey");
  const stereo::SurveyPictures pictures = stereo::photograph_survey(world_, bench_.model, rng);
  const auto seen = features_of(pictures.pairs, bench_.model, bench_.features);
  if (!seen) {
    return tl::unexpected<Error>(seen.error());
  }
  stereo::note_survey(pictures, *seen, record_);
  for (const std::size_t view : stereo::kShownViews) {
    shown_.push_back(pictures.pairs[view].left);
  }
  Result<std::vector<localize::Sighting>> views = stereo::survey_views(bench_, pictures.world_T_eyes, *seen, rng);
  if (!views) {
    return tl::unexpected<Error>(views.error());
  }
  views_ = std::move(*views);
  return {};
}

Status StereoRun::survey_and_drive() {
  if (Status ok = survey(); !ok) {
    return ok;
  }
  const auto frames = drive(world_, spec_.seed);
  if (!frames) {
    return tl::unexpected<Error>(frames.error());
  }
  struct Kind {
    const char* name;
    bool sparse;
    bool salient;
  };
  std::vector<stereo::Built> built;
  for (const Kind& kind : {Kind{"all", false, false}, Kind{"sparse", true, false}, Kind{"salient", true, true}}) {
    Result<stereo::Built> one = stereo::build(bench_, views_, kind.sparse, kind.salient);
    if (!one) {
      return tl::unexpected<Error>(one.error());
    }
    built.push_back(std::move(*one));
    salient_ = built.back().database;
    if (salient_->empty()) {
      return fail(Errc::kRefused, "the survey of seed " + std::to_string(spec_.seed) + " left no landmark");
    }
    if (Status ok = localise(kind.name, salient_, *frames, nullptr); !ok) {
      return ok;
    }
  }
  stereo::note_building(views_, built[1], built[2], shown_, record_);
  stereo::note_frames(*frames, matched_, record_);
  return {};
}

Status StereoRun::change_and_update() {
  if (spec_.paper && spec_.smallest) {
    return {};  // ours shows that it runs
  }
  Rng rng = rng_.fork("furniture");
  const Result<sim::World> moved = move_furniture(world_, bench_.model, kMovedShare, rng);
  if (!moved) {
    return tl::unexpected<Error>(moved.error());
  }
  const auto learning = drive(*moved, spec_.seed + 1000);
  const auto scoring = drive(*moved, spec_.seed + 2000);
  for (const auto* frames : {&learning, &scoring}) {
    if (!*frames) {
      return tl::unexpected<Error>(frames->error());
    }
  }
  localize::DatabaseUpdate update(bench_.model.stereo.geometry, bench_.update);
  if (Status ok = localise("changed", salient_, *learning, &update); !ok) {
    return ok;
  }
  if (Status ok = localise("outdated", salient_, *scoring, nullptr); !ok) {
    return ok;
  }
  const Result<localize::StagedUpdate> staged = update.stage(*salient_);
  StereoResult& result = record_.result;
  result.before = static_cast<int>(salient_->size());
  if (!staged) {
    result.refused = staged.error().message;
    return {};
  }
  const localize::UpdateCounts& counts = staged->counts;
  result.dynamic = counts.dynamic;
  result.duplicates = counts.duplicates;
  result.added = counts.added;
  result.removed = counts.removed;
  result.after = static_cast<int>(counts.after);
  return localise("updated", std::make_shared<const LandmarkDatabase>(staged->database), *scoring, nullptr);
}

/// Robots that are switched on anywhere in the surveyed room.
Status StereoRun::wake_up() {
  StereoResult& result = record_.result;
  Rng rng = rng_.fork("places");
  for (const Pose2& pose : random_poses(world_, bench_.model, spec_.smallest ? kSmallestPlaces : kPlaces, rng)) {
    const Result<stereo::Awakening> woken = stereo::wake_up(bench_, salient_, world_, pose, rng.bits());
    if (!woken) {
      return tl::unexpected<Error>(woken.error());
    }
    ++result.places;
    result.places_found += woken->found ? 1 : 0;
    result.places_wrong += woken->wrong ? 1 : 0;
    result.at_once += woken->at_once ? 1 : 0;
    result.at_once_wrong += woken->at_once_wrong ? 1 : 0;
    result.looks += woken->looks;
    result.looks_refused += woken->refused;
    result.looks_most = std::max(result.looks_most, woken->looks);
    relocalise_ms_.push_back(woken->relocalise_ms);
  }
  return {};
}

Status StereoRun::observe_foreign() {
  StereoResult& result = record_.result;
  Result<sim::World> foreign = load_laboratory(spec_.config, kForeignTextures + spec_.seed);
  if (!foreign) {
    return tl::unexpected<Error>(foreign.error());
  }
  Rng rng = rng_.fork("foreign room");
  const double longer = rng.uniform(kForeignLonger[0], kForeignLonger[1]);
  sim::stretch(*foreign, {longer, rng.uniform(kForeignNarrower[0], kForeignNarrower[1])});
  if (const auto moved = sim::move_objects(*foreign, kForeignShare, rng); !moved) {
    return tl::unexpected<Error>(moved.error());
  }
  Rng views_rng = rng_.fork("foreign");
  const int count = spec_.smallest ? kSmallestForeignViews : kForeignViews;
  const Result<stereo::ForeignViews> views = stereo::observe_foreign(bench_, salient_, *foreign, count, views_rng);
  if (!views) {
    return tl::unexpected<Error>(views.error());
  }
  result.foreign = count;
  result.foreign_found = views->found;
  result.foreign_empty = views->empty;
  relocalise_ms_.insert(relocalise_ms_.end(), views->relocalise_ms.begin(), views->relocalise_ms.end());
  return {};
}

Status StereoRun::relocalise() {
  // What is asked of the localiser is not asked of the paper's.
  if (spec_.paper) {
    return {};
  }
  if (Status ok = wake_up(); !ok) {
    return ok;
  }
  if (Status ok = observe_foreign(); !ok) {
    return ok;
  }
  const auto middle = relocalise_ms_.begin() + static_cast<std::ptrdiff_t>(relocalise_ms_.size() / 2);
  std::nth_element(relocalise_ms_.begin(), middle, relocalise_ms_.end());
  record_.result.relocalise_ms = *middle;
  return {};
}

}  // namespace

Result<std::string> settings_of(const StereoSpec& spec) {
  const SimSpec sim = sim_spec_of(spec);
  Result<TextHash> hash = settings_hash(sim_options(sim), sim);
  if (!hash) {
    return tl::unexpected<Error>(hash.error());
  }
  hash->add(spec.paper ? "paper" : "default");
  if (spec.smallest) {
    hash->add("smallest");
  }
  // What a run is has changed with these.
  hash->add(
      "poses adjusted, foreign rooms stretched, woken robots turn about, best landmarks kept, as configured, shown");
  return hash->hex();
}

Result<StereoRecord> run_stereo(const StereoSpec& spec) {
  const Result<app::RobotOptions> options = sim_options(sim_spec_of(spec));
  if (!options) {
    return tl::unexpected<Error>(options.error());
  }
  Result<sim::World> world = load_laboratory(spec.config, spec.seed);
  if (!world) {
    return tl::unexpected<Error>(world.error());
  }
  const Bench bench = stereo::bench_of(*options);
  StereoRun run(spec, bench, std::move(*world));
  for (const auto step : {&StereoRun::survey_and_drive, &StereoRun::change_and_update, &StereoRun::relocalise}) {
    if (Status ok = (run.*step)(); !ok) {
      return tl::unexpected<Error>(ok.error());
    }
  }
  StereoRecord record = run.take();
  record.result.seed = spec.seed;
  record.result.mode = spec.paper ? "paper" : "default";
  return record;
}

}  // namespace seeker::lab
