#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/text.hpp"
#include "server/nav/visibility.hpp"
#include "server/search/cut_off.hpp"
#include "server/search/goal_chooser.hpp"
#include "server/search/search_mission_impl.hpp"

namespace seeker::search {
namespace {

/// A track so near to a refused one is the same mistake: no second detour for it.
constexpr double kRefusedAgain_m = 0.6;
/// And so is one without a position, in the same direction from a place so near.
constexpr double kSameView_m = 2.0;
/// More answers than this were not asked for.
constexpr std::size_t kMaxPendingLooks = 16;
/// The last stretch before a target is the target itself in the occupancy.
constexpr double kTargetExtent_m = 0.25;
constexpr double kUnreachableRadius_m = 0.8;
constexpr double kPercent = 100.0;

bool floor_at(const Grid<std::uint8_t>& floor, const Point2& p_map) {
  const CellIndex cell = floor.frame().cell_of(p_map);
  return floor.contains(cell) && floor[cell] != 0;
}

}  // namespace

void SearchMission::Impl::add_looks(const std::vector<Look>& looks) {
  const bool finite =
      std::all_of(looks.begin(), looks.end(), [](const Look& look) { return is_finite(look.map_T_base); });
  if (end_ || looks.empty() || !finite || looks_.size() >= kMaxPendingLooks) {
    return;
  }
  PendingLook pending;
  pending.camera_map = (looks.front().map_T_base * params_.detection.base_T_camera).translation();
  for (const Look& look : looks) {
    for (const std::uint64_t id : tracker_.add(look)) {
      if (std::find(pending.seen.begin(), pending.seen.end(), id) == pending.seen.end()) {
        pending.seen.push_back(id);
      }
    }
  }
  looks_.push_back(std::move(pending));
}

void SearchMission::Impl::process_looks(const StrategyInput& input, SearchStep& out) {
  bool any = false;
  while (!looks_.empty() && !end_) {
    const PendingLook look = std::move(looks_.front());
    looks_.pop_front();
    process_look(look, input, out);
    any = true;
  }
  if (any) {
    image_missing_ = false;
    if (waiting_since_) {
      image_taken(input);
    }
  }
}

void SearchMission::Impl::process_look(const PendingLook& look, const StrategyInput& input, SearchStep& out) {
  // A robot that stands walled in still has the floor of a moment ago.
  const auto view = input.floors.view();
  const auto floor = view ? *view : input.floors.last();
  if (floor) {
    evidence_.add_look(floor->occupancy, look.camera_map, smallest_target_m());
    summary_ = evidence_.summary(floor_to_search(*floor, known_floor_));
    const auto refuted = tracker_.note_misses(look.seen, [&](const Point2& p, int target) {
      const Point2 d = p - look.camera_map;
      const double r = d.norm();
      const auto& spec = request_.targets[static_cast<std::size_t>(target)];
      const bool clear = r > kTargetExtent_m && nav::line_of_sight(floor->occupancy, look.camera_map,
                                                                   look.camera_map + (r - kTargetExtent_m) / r * d);
      return clear ? params_.hit_rate.probability(r, std::min(spec.width_m, spec.height_m)) : 0.0;
    });
    for (const std::uint64_t id : refuted) {
      out.events.push_back({"refuted", "detection " + std::to_string(id) + " was not seen again"});
    }
  }
  for (Unconfirmed& one : to_confirm_) {
    ++one.looks;
  }
  for (const std::uint64_t id : look.seen) {
    if (!end_) {
      note_sighting(id, input, out);
    }
  }
}

void SearchMission::Impl::note_sighting(std::uint64_t id, const StrategyInput& input, SearchStep& out) {
  const auto detection = tracker_.find(id);
  if (!detection) {
    return;
  }
  if (!detection->confirmed && refused_before(*detection)) {
    tracker_.refute(id);
    return;
  }
  if (sighted_.insert(id).second) {
    const std::string where = detection->position_map
                                  ? " near " + text(*detection->position_map)
                                  : " at a bearing of " + text(rad_to_deg(detection->bearing_map_rad)) + " deg";
    out.events.push_back({"sighting", "detection " + std::to_string(id) + ": " + name_of(detection->target) + where +
                                          ", score " + text(detection->score)});
    if (!detection->confirmed && out_of_reach(*detection)) {
      out.events.push_back(
          {"refuted", "detection " + std::to_string(id) + " is farther off than targets are recognised"});
      tracker_.refute(id);
      return;
    }
    if (!detection->confirmed) {
      to_confirm_.push_back({id});
    }
  }
  if (detection->confirmed && confirmed_.insert(id).second) {
    note_confirmed(*detection, input, out);
  }
}

void SearchMission::Impl::note_confirmed(const Detection& detection, const StrategyInput& input, SearchStep& out) {
  out.events.push_back({"confirmed", "detection " + std::to_string(detection.id) + ": " + name_of(detection.target) +
                                         " confirmed by " + std::to_string(detection.sightings) + " sightings"});
  switch (request_.on_found) {
    case OnFound::kStop: finish_found(detection.id, out); break;
    case OnFound::kApproach:
      if (!visit_.approaching()) {
        visit_.begin_approach(detection, input.now);
      }
      break;
    case OnFound::kContinue: break;
  }
}

/// A doubtful sighting from where the recogniser hardly sees targets is worth no detour, and two of them no belief:
/// that floor still counts as unsearched, so that the search gets there anyway.
bool SearchMission::Impl::out_of_reach(const Detection& detection) const {
  const auto place = tracker_.presumed_place(detection.id);
  return params_.detection.doubtful(detection.score) && place &&
         (*place - detection.map_T_base.translation()).norm() > params_.hit_rate.max_range_m;
}

bool SearchMission::Impl::confirm_next(RobotTime now, bool doubtful_too) {
  std::erase_if(to_confirm_, [this](const Unconfirmed& one) {
    const auto detection = tracker_.find(one.id);
    return !detection || detection->confirmed;
  });
  const auto due = std::find_if(to_confirm_.begin(), to_confirm_.end(), [&](const Unconfirmed& one) {
    return doubtful_too || !params_.detection.doubtful(tracker_.find(one.id)->score) ||
           one.looks >= params_.mission.doubtful_looks;
  });
  if (visit_.active() || due == to_confirm_.end()) {
    return false;
  }
  visit_.begin_confirm(due->id, now);
  to_confirm_.erase(due);
  return true;
}

void SearchMission::Impl::run_visit(const StrategyInput& input, SearchStep& out) {
  StrategyStep step;
  const std::uint64_t id = visit_.id();
  const bool approaching = visit_.approaching();
  const VisitResult result = visit_.step(input, tracker_, step);
  hand_over(std::move(step), input, out);
  if (result == VisitResult::kBusy) {
    return;
  }
  strategy_->interrupted(input.now);
  if (result == VisitResult::kReached) {
    finish_found(id, out);
  } else if (result == VisitResult::kRefused) {
    note_refusal(id);
    out.events.push_back({"refuted", "detection " + std::to_string(id) +
                                         (approaching ? " is not there from near" : " could not be confirmed")});
    approach_next(input.now);
  }
}

void SearchMission::Impl::approach_next(RobotTime now) {
  for (const std::uint64_t id : confirmed_) {
    const auto detection = tracker_.find(id);
    if (detection && request_.on_found == OnFound::kApproach) {
      visit_.begin_approach(*detection, now);
      return;
    }
  }
}

bool SearchMission::Impl::refused_before(const Detection& detection) const {
  if (detection.position_map) {
    return nav::near_any(*detection.position_map, refused_, kRefusedAgain_m);
  }
  return std::any_of(refused_bearings_.begin(), refused_bearings_.end(), [&](const Pose2& from) {
    return distance_m(from, detection.map_T_base) < kSameView_m &&
           std::abs(wrap_angle(from.theta_rad - detection.bearing_map_rad)) < params_.detection.min_parallax_rad;
  });
}

void SearchMission::Impl::note_refusal(std::uint64_t id) {
  if (const auto detection = tracker_.find(id)) {
    if (detection->position_map) {
      refused_.push_back(*detection->position_map);
    } else {
      refused_bearings_.push_back({detection->map_T_base.x_m, detection->map_T_base.y_m, detection->bearing_map_rad});
    }
  }
  tracker_.refute(id);
}

/// As wide as a square of the floor about the place that was not searched, or as the frontier that it is.
std::vector<UnreachablePlace> SearchMission::Impl::unreachable_places() const {
  std::vector<UnreachablePlace> places = strategy_->unreachable();
  const auto& floor = floors_.last();
  if (!floor) {
    return places;
  }
  const Grid<std::uint8_t> to_search = floor_to_search(*floor, known_floor_);
  const double cell_m = to_search.frame().resolution_m;
  for (UnreachablePlace& place : places) {
    int unsearched = 0;
    for (std::size_t k = 0; k < to_search.cells().size(); ++k) {
      const Point2 p_map = to_search.frame().centre_of(to_search.cell(k));
      const bool left = to_search.cells()[k] != 0 && (p_map - place.p_map).norm() < kUnreachableRadius_m &&
                        evidence_.probability_at(p_map) < evidence_.params().threshold;
      unsearched += left ? 1 : 0;
    }
    place.size_m = std::max(place.size_m, cell_m * std::sqrt(static_cast<double>(unsearched)));
  }
  return places;
}

void SearchMission::Impl::finish(EndKind kind, std::string cause, std::string remedy, SearchStep& out) {
  end_ = SearchEnd{kind, std::move(cause), std::move(remedy), unreachable_places()};
  out.events.push_back({"end", std::string(to_string(kind)) + ": " + end_->cause});
}

/// "; not found: 'ring', 'arrow'": of several targets those that nothing was seen of.
std::string SearchMission::Impl::not_found() const {
  std::string list;
  for (std::size_t k = 0; k < request_.targets.size(); ++k) {
    const bool seen = std::any_of(confirmed_.begin(), confirmed_.end(), [&](std::uint64_t id) {
      const auto detection = tracker_.find(id);
      return detection && detection->target == static_cast<int>(k);
    });
    if (!seen) {
      list += (list.empty() ? "; not found: " : ", ") + name_of(static_cast<int>(k));
    }
  }
  return list;
}

void SearchMission::Impl::finish_found(std::uint64_t id, SearchStep& out) {
  const auto detection = tracker_.find(id);
  std::string cause = "the target was found";
  std::string remedy;
  if (detection) {
    cause = "target " + name_of(detection->target) + " found at a bearing of " +
            text(rad_to_deg(detection->bearing_map_rad)) + " deg";
    if (detection->position_map) {
      const double sigma = std::sqrt(std::max(0.0, detection->position_covariance.trace()));
      cause += ", position " + text(*detection->position_map) + ", uncertain by " + text(sigma) + " m";
    } else {
      remedy = "no range was measured; look from a second place to get the position";
    }
  }
  finish(EndKind::kTargetFound, cause + not_found(), std::move(remedy), out);
}

void SearchMission::Impl::finish_covered(const StrategyStep& step, const StrategyInput& input, SearchStep& out) {
  if (const auto floor = input.floors.view(true)) {
    summary_ = evidence_.summary(floor_to_search(**floor, known_floor_));
  }
  if (request_.on_found == OnFound::kContinue && !confirmed_.empty()) {
    finish_found(*confirmed_.begin(), out);
    return;
  }
  const double share = summary_.reachable_area_m2 > 0.0 ? summary_.covered_area_m2 / summary_.reachable_area_m2 : 0.0;
  const std::string covered = text(kPercent * share) + " % of " + text(summary_.reachable_area_m2) +
                              " m\xC2\xB2 reachable floor seen with probability " + text(summary_.threshold) +
                              " or more";
  const bool walled_in = summary_.reachable_area_m2 <= 0.0;
  if (step.trapped || walled_in) {
    const std::string cause = walled_in ? "the robot is walled in: there is no floor around it to drive on" : covered;
    finish(EndKind::kUnreachable, step.activity + "; " + cause, "free the robot or move it, then start again", out);
    const Point2 here = input.map_T_base.translation();
    end_->unreachable.insert(end_->unreachable.begin(), {here, request_.areas.cause_of_no_floor(here), 0.0, ""});
    return;
  }
  const std::vector<UnreachablePlace> unreachable = unreachable_places();
  finish(EndKind::kNotFoundAreaCovered,
         step.activity + "; " + covered + "; " + std::to_string(unreachable.size()) + " places unreachable" +
             (unreachable.empty() ? "" : ": " + describe(unreachable)),
         share < 1.0 ? (request_.gaps_only ? "look at the listed gaps by hand"
                                           : "search the gaps only, or look at the listed gaps by hand")
                     : "",
         out);
}

EvidenceReport SearchMission::Impl::evidence_report() const {
  const auto& floor = floors_.last();
  if (!floor) {
    return {};
  }
  const auto everything = floors_.unrestricted_floor();
  const std::vector<Point2>& unreachable = strategy_->lists().unreachable;
  const Grid<std::uint8_t> to_search = floor_to_search(*floor, known_floor_);
  return evidence_.report(to_search, [&](const Point2& p) -> std::optional<std::string> {
    if (floor_at(to_search, p) && !floor_at(floor->reachable, p)) {
      return "cut off";
    }
    if (floor_at(to_search, p)) {
      return nav::near_any(p, unreachable, kUnreachableRadius_m) ? std::optional<std::string>("unreachable")
                                                                 : std::nullopt;
    }
    if (!everything || !floor_at(*everything, p)) {
      return std::nullopt;
    }
    return request_.areas.outside_bound(p) ? "outside the bound" : "keep-out";
  });
}

}  // namespace seeker::search
