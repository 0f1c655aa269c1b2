#include "common/wire/convert.hpp"
#include "common/wire/hash_field.hpp"

namespace seeker::wire {
namespace {

void write_polygons(const std::vector<Polygon>& from, google::protobuf::RepeatedPtrField<pb::Polygon>* to) {
  for (const Polygon& polygon : from) {
    write(polygon, to->Add()->mutable_corners());
  }
}

void read_polygon(const pb::Polygon& from, Polygon& to, Check& check) {
  const auto scope = check.in("corners");
  read(from.corners(), to, check, kMaxPolygonCorners);
}

void read_polygons(const google::protobuf::RepeatedPtrField<pb::Polygon>& from, std::vector<Polygon>& to,
                   Check& check) {
  if (!check.count("keep_out", static_cast<std::size_t>(from.size()), api::kMaxKeepOuts)) {
    return;
  }
  to.resize(static_cast<std::size_t>(from.size()));
  for (std::size_t k = 0; k < to.size(); ++k) {
    const auto scope = check.in("keep_out", k);
    read_polygon(from.Get(static_cast<int>(k)), to[k], check);
  }
}

/// The bound and the kept-out areas, which several missions have.
template <class T, class M>
void write_areas(const T& from, M* to) {
  if (from.bound) {
    write(*from.bound, to->mutable_bound()->mutable_corners());
  }
  write_polygons(from.keep_out, to->mutable_keep_out());
}

template <class M, class T>
void read_areas(const M& from, T& to, Check& check) {
  if (from.has_bound()) {
    const auto scope = check.in("bound");
    read_polygon(from.bound(), to.bound.emplace(), check);
  }
  read_polygons(from.keep_out(), to.keep_out, check);
}

void write_target(const api::TargetSpec& from, pb::Target* to) {
  to->set_name(clean_text(from.name, kMaxNameBytes));
  if (from.recogniser == api::RecogniserKind::kSolid) {
    to->set_solid(static_cast<pb::Solid>(wire_enum(from.solid)));
  } else if (from.picture_hash) {
    to->set_picture_sha256(bytes_of(*from.picture_hash));
  } else {
    write(from.picture, to->mutable_picture());
  }
  to->set_width_m(from.width_m);
  to->set_height_m(from.height_m);
  to->set_depth_m(from.depth_m);
  to->set_recogniser(static_cast<pb::Recogniser>(wire_enum(from.recogniser)));
}

void read_target(const pb::Target& from, api::TargetSpec& to, Check& check) {
  to.name = check.text("name", from.name(), kMaxNameBytes);
  // Before unpacking: a target is small, so a peer must not make us allocate for a large one.
  if (from.picture().width_px() > static_cast<std::uint32_t>(api::kMaxTargetSide_px) ||
      from.picture().height_px() > static_cast<std::uint32_t>(api::kMaxTargetSide_px)) {
    check.refuse("picture", Errc::kTooLarge, "is larger than 1024 pixels; scale it down");
    return;
  }
  check.enumerator("recogniser", from.recogniser(), api::RecogniserKind::kSolid, to.recogniser);
  if (to.recogniser == api::RecogniserKind::kSolid) {
    check.enumerator("solid", from.solid(), kSolidKinds.back(), to.solid);
  } else if (!from.picture_sha256().empty()) {
    read_hash("picture_sha256", from.picture_sha256(), to.picture_hash.emplace(), check);
  } else {
    read_required(from.has_picture(), from.picture(), to.picture, "picture", check);
  }
  to.width_m = check.finite("width_m", from.width_m());
  to.height_m = check.finite("height_m", from.height_m());
  to.depth_m = check.finite("depth_m", from.depth_m());
}

template <class M>
void write_targets(const std::vector<api::TargetSpec>& from, M* to) {
  for (const api::TargetSpec& target : from) {
    write_target(target, to->add_targets());
  }
}

template <class M>
void read_targets(const M& from, std::vector<api::TargetSpec>& to, Check& check) {
  if (!check.count("targets", static_cast<std::size_t>(from.targets_size()), api::kMaxTargets)) {
    return;
  }
  to.resize(static_cast<std::size_t>(from.targets_size()));
  for (std::size_t k = 0; k < to.size() && check.ok(); ++k) {
    const auto scope = check.in("targets", k);
    read_target(from.targets(static_cast<int>(k)), to[k], check);
  }
}

struct TaskWriter {
  pb::MissionRequest* to;

  void operator()(const api::SearchMission& from) const {
    pb::SearchMission* search = to->mutable_search();
    write_targets(from.targets, search);
    search->set_mode(static_cast<pb::SearchMode>(wire_enum(from.mode)));
    search->set_on_found(static_cast<pb::OnFound>(wire_enum(from.on_found)));
    write_areas(from, search);
    search->set_gaps_only(from.gaps_only);
    search->set_explore(from.explore);
  }
  void operator()(const api::GotoMission& from) const {
    pb::GotoMission* go = to->mutable_go_to();
    write(from.waypoints, go->mutable_waypoints());
    if (from.final_heading_rad) {
      go->set_final_heading_rad(*from.final_heading_rad);
    }
    write_polygons(from.keep_out, go->mutable_keep_out());
  }
  void operator()(const api::ReturnMission& from) const { write_areas(from, to->mutable_return_home()); }
  void operator()(const api::ExploreMission& from) const {
    pb::ExploreMission* explore = to->mutable_explore();
    explore->set_strategy(static_cast<pb::ExploreStrategy>(wire_enum(from.strategy)));
    write_areas(from, explore);
    explore->set_return_to_start(from.return_to_start);
  }
  void operator()(const api::SurveyMission& from) const {
    pb::SurveyMission* survey = to->mutable_survey();
    survey->set_landmarks(clean_text(from.landmarks, kMaxNameBytes));
    write(from.places, survey->mutable_places());
    survey->set_headings(static_cast<std::uint32_t>(from.headings));
    survey->set_replace(from.replace);
    write_polygons(from.keep_out, survey->mutable_keep_out());
  }
  void operator()(const api::LocaliseMission& from) const {
    to->mutable_localise()->set_landmarks(clean_text(from.landmarks, kMaxNameBytes));
    to->mutable_localise()->set_headings(static_cast<std::uint32_t>(from.headings));
  }
  void operator()(const api::RecogniseMission& from) const {
    write_targets(from.targets, to->mutable_recognise());
    to->mutable_recognise()->set_headings(static_cast<std::uint32_t>(from.headings));
  }
};

void read_search(const pb::SearchMission& from, api::SearchMission& to, Check& check) {
  read_targets(from, to.targets, check);
  if (!check.ok()) {
    return;
  }
  check.enumerator("mode", from.mode(), api::SearchMode::kPlan, to.mode);
  check.enumerator("on_found", from.on_found(), api::OnFound::kContinue, to.on_found);
  read_areas(from, to, check);
  to.gaps_only = from.gaps_only();
  to.explore = from.explore();
}

void read_explore(const pb::ExploreMission& from, api::ExploreMission& to, Check& check) {
  check.enumerator("strategy", from.strategy(), api::kExploreStrategies.back(), to.strategy);
  read_areas(from, to, check);
  to.return_to_start = from.return_to_start();
}

void read_survey(const pb::SurveyMission& from, api::SurveyMission& to, Check& check) {
  to.landmarks = check.text("landmarks", from.landmarks(), kMaxNameBytes);
  {
    const auto scope = check.in("places");
    read(from.places(), to.places, check, api::kMaxSurveyPlaces);
  }
  to.headings = check.natural("headings", from.headings());
  to.replace = from.replace();
  read_polygons(from.keep_out(), to.keep_out, check);
}

void read_localise(const pb::LocaliseMission& from, api::LocaliseMission& to, Check& check) {
  to.landmarks = check.text("landmarks", from.landmarks(), kMaxNameBytes);
  to.headings = check.natural("headings", from.headings());
}

void read_recognise(const pb::RecogniseMission& from, api::RecogniseMission& to, Check& check) {
  read_targets(from, to.targets, check);
  to.headings = check.natural("headings", from.headings());
}

void read_goto(const pb::GotoMission& from, api::GotoMission& to, Check& check) {
  {
    const auto scope = check.in("waypoints");
    read(from.waypoints(), to.waypoints, check, api::kMaxWaypoints);
  }
  if (from.has_final_heading_rad()) {
    to.final_heading_rad = check.finite("final_heading_rad", from.final_heading_rad());
  }
  read_polygons(from.keep_out(), to.keep_out, check);
}

void write_end(const api::MissionEnd& from, pb::MissionEnd* to) {
  to->set_outcome(static_cast<pb::Outcome>(wire_enum(from.outcome)));
  to->set_cause(clean_text(from.cause));
  to->set_remedy(clean_text(from.remedy));
  write_unreachable(from.unreachable, to);
}

void read_end(const pb::MissionEnd& from, api::MissionEnd& to, Check& check) {
  check.enumerator("outcome", from.outcome(), api::Outcome::kFault, to.outcome);
  to.cause = check.text("cause", from.cause());
  to.remedy = check.text("remedy", from.remedy());
  read_unreachable(from, to.unreachable, check);
}

}  // namespace

void write(const api::MissionRequest& from, pb::MissionRequest* to) {
  to->set_id(clean_text(from.id, kMaxNameBytes + 1));
  std::visit(TaskWriter{to}, from.task);
  to->set_link_policy(static_cast<pb::LinkPolicy>(wire_enum(from.link_policy)));
  if (from.time_limit) {
    to->set_time_limit_ns(from.time_limit->count());
  }
  write(from.link_steps, *to->mutable_link_steps());
}

void read(const pb::MissionRequest& from, api::MissionRequest& to, Check& check) {
  to.id = check.text("id", from.id(), kMaxNameBytes);
  switch (from.task_case()) {
    case pb::MissionRequest::kSearch: {
      const auto scope = check.in("search");
      read_search(from.search(), to.task.emplace<api::SearchMission>(), check);
      break;
    }
    case pb::MissionRequest::kGoTo: {
      const auto scope = check.in("go_to");
      read_goto(from.go_to(), to.task.emplace<api::GotoMission>(), check);
      break;
    }
    case pb::MissionRequest::kReturnHome: {
      const auto scope = check.in("return_home");
      read_areas(from.return_home(), to.task.emplace<api::ReturnMission>(), check);
      break;
    }
    case pb::MissionRequest::kExplore: {
      const auto scope = check.in("explore");
      read_explore(from.explore(), to.task.emplace<api::ExploreMission>(), check);
      break;
    }
    case pb::MissionRequest::kSurvey: {
      const auto scope = check.in("survey");
      read_survey(from.survey(), to.task.emplace<api::SurveyMission>(), check);
      break;
    }
    case pb::MissionRequest::kLocalise: {
      const auto scope = check.in("localise");
      read_localise(from.localise(), to.task.emplace<api::LocaliseMission>(), check);
      break;
    }
    case pb::MissionRequest::kRecognise: {
      const auto scope = check.in("recognise");
      read_recognise(from.recognise(), to.task.emplace<api::RecogniseMission>(), check);
      break;
    }
    case pb::MissionRequest::TASK_NOT_SET:
      check.refuse("task", Errc::kInvalidArgument, "is missing or of a kind that is not known here");
      break;
  }
  check.enumerator("link_policy", from.link_policy(), api::LinkPolicy::kReturn, to.link_policy);
  read(from.link_steps(), to.link_steps, check);
  if (from.has_time_limit_ns()) {
    to.time_limit = Duration(from.time_limit_ns());
  }
}

void write(const api::MissionStatus& from, pb::MissionStatus* to) {
  to->set_id(clean_text(from.id, kMaxNameBytes));
  to->set_kind(clean_text(from.kind, kMaxNameBytes));
  to->set_state(static_cast<pb::MissionState>(wire_enum(from.state)));
  to->set_phase(clean_text(from.phase, kMaxNameBytes));
  to->set_activity(clean_text(from.activity));
  to->set_progress(from.progress);
  to->set_started_ns(from.started.time_since_epoch().count());
  to->set_updated_ns(from.updated.time_since_epoch().count());
  to->set_path_length_m(from.path_length_m);
  to->set_cells_searched(static_cast<std::uint32_t>(from.cells_searched));
  to->set_cells_unsearched(static_cast<std::uint32_t>(from.cells_unsearched));
  if (from.coverage) {
    write(*from.coverage, to->mutable_coverage());
  }
  write(from.planned_path, to->mutable_planned_path());
  to->set_link_policy(static_cast<pb::LinkPolicy>(wire_enum(from.link_policy)));
  if (from.end) {
    write_end(*from.end, to->mutable_end());
  }
  if (from.decision) {
    write(*from.decision, to->mutable_decision());
  }
  write(from.link_steps, *to->mutable_link_steps());
}

void read(const pb::MissionStatus& from, api::MissionStatus& to, Check& check) {
  to.id = check.text("id", from.id(), kMaxNameBytes);
  to.kind = check.text("kind", from.kind(), kMaxNameBytes);
  check.enumerator("state", from.state(), api::MissionState::kEnded, to.state);
  to.phase = check.text("phase", from.phase(), kMaxNameBytes);
  to.activity = check.text("activity", from.activity());
  to.progress = check.finite("progress", from.progress());
  to.started = RobotTime(Duration(from.started_ns()));
  to.updated = RobotTime(Duration(from.updated_ns()));
  to.path_length_m = check.finite("path_length_m", from.path_length_m());
  to.cells_searched = check.natural("cells_searched", from.cells_searched());
  to.cells_unsearched = check.natural("cells_unsearched", from.cells_unsearched());
  if (from.has_coverage()) {
    const auto scope = check.in("coverage");
    read(from.coverage(), to.coverage.emplace(), check);
  }
  {
    const auto scope = check.in("planned_path");
    read(from.planned_path(), to.planned_path, check, kMaxPathPoints);
  }
  check.enumerator("link_policy", from.link_policy(), api::LinkPolicy::kReturn, to.link_policy);
  read(from.link_steps(), to.link_steps, check);
  if (from.has_end() != (to.state == api::MissionState::kEnded)) {
    check.refuse("end", Errc::kInvalidArgument, "must be present exactly when the mission has ended");
  }
  if (from.has_end()) {
    const auto scope = check.in("end");
    read_end(from.end(), to.end.emplace(), check);
  }
  if (from.has_decision()) {
    const auto scope = check.in("decision");
    read(from.decision(), to.decision.emplace(), check);
  }
}

}  // namespace seeker::wire
