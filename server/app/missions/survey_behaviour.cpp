#include "server/app/missions/survey_behaviour.hpp"

#include "common/core/text.hpp"
#include "server/localize/survey_adjustment.hpp"

namespace seeker::app {
namespace {

/// Where the robot stands, and four places around it.
std::vector<Point2> places_around(const Pose2& map_T_base, double spacing_m) {
  std::vector<Point2> places = {map_T_base.translation()};
  for (const Point2& offset : {Point2(1.0, 0.0), Point2(0.0, 1.0), Point2(-1.0, 0.0), Point2(0.0, -1.0)}) {
    places.push_back(map_T_base * (spacing_m * offset));
  }
  return places;
}

/// In the order in which the pictures were taken, then only what was seen often enough.
Result<localize::LandmarkDatabase> build(const SurveySettings& settings, std::vector<localize::Sighting> sightings) {
  const auto adjusted = localize::adjust_poses(settings.geometry, settings.database, sightings);
  if (!adjusted) {
    return tl::unexpected<Error>(adjusted.error());
  }
  localize::SurveyBuilder builder(settings.geometry, settings.database);
  for (const localize::Sighting& sighting : sightings) {
    if (const Result<localize::SightingCounts> added = builder.add(sighting); !added) {
      return tl::unexpected<Error>(added.error());
    }
  }
  localize::LandmarkDatabase database = builder.salient();
  if (database.empty()) {
    return fail(Errc::kRefused, std::to_string(sightings.size()) + " looks showed no landmark often enough");
  }
  return database;
}

}  // namespace

Result<std::unique_ptr<Behaviour>> SurveyBehaviour::create(const SurveySettings& settings,
                                                           const api::SurveyMission& mission,
                                                           std::shared_ptr<LandmarkLibrary> library,
                                                           const Situation& situation) {
  if (!situation.has_stereo) {
    return fail(Errc::kRefused, "this robot has no stereo camera to survey with");
  }
  if (const Status free = library->check_free(mission.landmarks, mission.replace); !free) {
    return tl::unexpected<Error>(free.error());
  }
  return std::unique_ptr<Behaviour>(new SurveyBehaviour(settings, mission, std::move(library), situation));
}

SurveyBehaviour::SurveyBehaviour(const SurveySettings& settings, const api::SurveyMission& mission,
                                 std::shared_ptr<LandmarkLibrary> library, const Situation& situation)
    : settings_(settings),
      mission_(mission),
      library_(std::move(library)),
      map_name_(situation.map_name),
      places_given_(!mission.places.empty()),
      sweep_(settings.params.look),
      saving_(settings.inline_work, "the database of landmarks could not be made") {
  if (!places_given_) {
    mission_.places = places_around(situation.pose.map_T_base, settings_.params.spacing_m);
  }
  begin_place();
}

double SurveyBehaviour::progress() const {
  const double here =
      phase_ == Phase::kLook ? static_cast<double>(sweep_.index()) / static_cast<double>(sweep_.headings()) : 0.0;
  return (static_cast<double>(place_) + here) / static_cast<double>(mission_.places.size());
}

void SurveyBehaviour::begin_place() {
  if (place_ == mission_.places.size()) {
    begin_save();
    return;
  }
  phase_ = Phase::kDrive;
  api::GotoMission go;
  go.waypoints = {mission_.places[place_]};
  go.keep_out = mission_.keep_out;
  drive_ = std::make_unique<GotoBehaviour>(settings_.go, std::move(go));
}

void SurveyBehaviour::begin_save() {
  phase_ = Phase::kSave;
  saving_.start([settings = settings_, sightings = sightings_, library = library_, name = mission_.landmarks,
                 map = map_name_, replace = mission_.replace]() -> Result<api::LandmarkSummary> {
    const Result<localize::LandmarkDatabase> database = build(settings, sightings);
    if (!database) {
      return tl::unexpected<Error>(database.error());
    }
    return library->create(name, *database, map, replace);
  });
}

Decision SurveyBehaviour::step(const Situation& situation) {
  Decision decision;
  decision.events = std::exchange(events_, {});
  switch (phase_) {
    case Phase::kDrive: drive(situation, decision); break;
    case Phase::kLook: look(situation, decision); break;
    case Phase::kSave: save(decision); break;
  }
  decision.progress = progress();
  return decision;
}

void SurveyBehaviour::drive(const Situation& situation, Decision& decision) {
  Decision way = drive_->step(situation);
  decision.command = way.command;
  decision.planned_path = std::move(way.planned_path);
  decision.phase = "drive";
  decision.activity = way.activity + " to look around there";
  if (!way.end) {
    return;
  }
  decision.step_done = true;
  if (way.end->outcome == api::Outcome::kComplete) {
    phase_ = Phase::kLook;
    sweep_.start(situation.pose.map_T_base, mission_.headings);
    return;
  }
  for (BehaviourEvent& event : way.events) {
    if (event.kind == "unreachable") {
      decision.events.push_back(std::move(event));
    }
  }
  if (places_given_) {
    unreachable_.insert(unreachable_.end(), way.end->unreachable.begin(), way.end->unreachable.end());
  }
  ++place_;
  begin_place();
}

void SurveyBehaviour::look(const Situation& situation, Decision& decision) {
  decision.phase = "look";
  if (!sweep_.active()) {
    decision.step_done = true;
    ++place_;
    begin_place();
    return;
  }
  decision.activity = "looking around at " + text(mission_.places[place_]) + " m, direction " +
                      std::to_string(sweep_.index() + 1) + " of " + std::to_string(sweep_.headings());
  sweep_.step(situation.pose.map_T_base, situation, decision);
}

void SurveyBehaviour::on_look(const Result<StereoLook>& look) {
  if (phase_ != Phase::kLook) {
    return;
  }
  const bool sure = look && look->pose.quality == LocalisationQuality::kLocalised;
  if (!sure) {
    const std::string why = look ? "the pose is " + std::string(to_string(look->pose.quality)) : look.error().message;
    if (sweep_.failed()) {
      events_.push_back({"heading-left-out", why, api::Severity::kWarning});
    }
    return;
  }
  localize::Sighting sighting;
  sighting.stamp = look->stamp;
  sighting.map_T_eye = localize::eye_from_base(look->pose.map_T_base, settings_.arm);
  sighting.pose_covariance = localize::eye_covariance(look->pose.map_T_base, look->pose.covariance, settings_.arm);
  sighting.eye_height_m = settings_.eye_height_m;
  sighting.features = look->features.features;
  events_.push_back(
      {"looked", std::to_string(sighting.features.size()) + " points with a depth", api::Severity::kInfo});
  sightings_.push_back(std::move(sighting));
  sweep_.looked();
}

void SurveyBehaviour::save(Decision& decision) {
  decision.phase = "save";
  decision.activity = "making the database of " + std::to_string(sightings_.size()) + " looks";
  const std::optional<Result<api::LandmarkSummary>> saved = saving_.take();
  if (!saved) {
    return;
  }
  api::MissionEnd end;
  if (!*saved) {
    end.outcome = api::Outcome::kFault;
    end.cause = "no database was made: " + saved->error().message;
    end.remedy = "survey places with more texture, nearer to each other";
    if (sightings_.empty() && !unreachable_.empty()) {
      end.outcome = api::Outcome::kUnreachable;
      end.remedy.clear();
    }
  } else {
    end.outcome = unreachable_.empty() ? api::Outcome::kComplete : api::Outcome::kUnreachable;
    end.cause = std::to_string((*saved)->landmarks) + " landmarks from " + std::to_string(sightings_.size()) +
                " looks are kept as '" + (*saved)->name + "'";
  }
  if (!unreachable_.empty()) {
    end.cause += "; " + std::to_string(unreachable_.size()) + " of " + std::to_string(mission_.places.size()) +
                 " places cannot be reached: " + describe(unreachable_);
    end.remedy += (end.remedy.empty() ? "" : "; ") + remedies_of(unreachable_);
    end.unreachable = unreachable_;
  }
  decision.end = std::move(end);
}

void SurveyBehaviour::map_moved(const MapMove& move) {
  for (localize::Sighting& sighting : sightings_) {
    sighting.map_T_eye = move * sighting.map_T_eye;
  }
  if (!places_given_) {
    for (Point2& place : mission_.places) {
      place = move * place;
    }
  }
  sweep_.resumed();
  drive_->map_moved(move);
}

void SurveyBehaviour::resumed(RobotTime now) {
  sweep_.resumed();
  drive_->resumed(now);
}

}  // namespace seeker::app
