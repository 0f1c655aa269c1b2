#include "common/core/unreachable.hpp"

#include <algorithm>

#include "common/core/text.hpp"

namespace seeker {
namespace {

/// More places than these are counted only; a mission lists all of them as values.
constexpr std::size_t kMostDescribed = 8;

}  // namespace

std::string_view to_string(UnreachableCause cause) {
  switch (cause) {
    case UnreachableCause::kNotStated: return "not-stated";
    case UnreachableCause::kObstacle: return "obstacle";
    case UnreachableCause::kOutsideBound: return "outside-bound";
    case UnreachableCause::kKeptOut: return "kept-out";
    case UnreachableCause::kUnknownFloor: return "unknown-floor";
    case UnreachableCause::kCutOff: return "cut-off";
    case UnreachableCause::kCutOffByAreas: return "cut-off-by-areas";
    case UnreachableCause::kRobotEnclosed: return "robot-enclosed";
    case UnreachableCause::kRobotForbidden: return "robot-forbidden";
    case UnreachableCause::kBlocked: return "blocked";
  }
  return "";
}

std::string_view explain(UnreachableCause cause) {
  switch (cause) {
    case UnreachableCause::kNotStated: return "the robot does not state why";
    case UnreachableCause::kObstacle: return "it lies in an obstacle, or too near to one for the robot's body";
    case UnreachableCause::kOutsideBound: return "it lies outside the bound of the mission";
    case UnreachableCause::kKeptOut: return "it lies in a kept-out area, or too near to one for the robot's body";
    case UnreachableCause::kUnknownFloor: return "the floor there has not been seen";
    case UnreachableCause::kCutOff: return "no path leads there: obstacles or unknown floor lie between";
    case UnreachableCause::kCutOffByAreas: return "no path leads there but through kept-out areas or outside the bound";
    case UnreachableCause::kRobotEnclosed: return "the robot itself stands too near to obstacles to set out";
    case UnreachableCause::kRobotForbidden: return "the robot itself stands outside the bound or in a kept-out area";
    case UnreachableCause::kBlocked: return "every path there was blocked";
  }
  return "";
}

std::string_view remedy_of(UnreachableCause cause) {
  switch (cause) {
    case UnreachableCause::kNotStated: return "";
    case UnreachableCause::kObstacle: return "choose a place farther from walls and furniture";
    case UnreachableCause::kOutsideBound: return "choose a place inside the bound, or give a wider bound";
    case UnreachableCause::kKeptOut: return "choose a place outside the kept-out areas, or give smaller ones";
    case UnreachableCause::kUnknownFloor: return "have the robot see that floor first: explore, or drive nearer";
    case UnreachableCause::kCutOff: return "open doors and clear the floor between, then try again";
    case UnreachableCause::kCutOffByAreas: return "give smaller kept-out areas or a wider bound";
    case UnreachableCause::kRobotEnclosed:
      return "move the robot away from the obstacles by hand or with 'seeker drive', then try again";
    case UnreachableCause::kRobotForbidden:
      return "drive the robot to where the mission allows it to be, or give other areas";
    case UnreachableCause::kBlocked: return "clear what stands on the path, then try again";
  }
  return "";
}

std::vector<Point2> positions_of(const std::vector<UnreachablePlace>& places) {
  std::vector<Point2> positions;
  positions.reserve(places.size());
  for (const UnreachablePlace& place : places) {
    positions.push_back(place.p_map);
  }
  return positions;
}

std::string describe(const UnreachablePlace& place) {
  const std::string width = place.size_m > 0.0 ? ", " + text(place.size_m) + " m wide" : "";
  const std::string why = place.text.empty() ? std::string(explain(place.cause)) : place.text;
  return text(place.p_map) + " m" + width + ": " + why;
}

std::string describe(const std::vector<UnreachablePlace>& places) {
  std::string list;
  for (std::size_t k = 0; k < std::min(places.size(), kMostDescribed); ++k) {
    list += (list.empty() ? "" : "; ") + describe(places[k]);
  }
  if (places.size() > kMostDescribed) {
    list += "; and " + std::to_string(places.size() - kMostDescribed) + " more";
  }
  return list;
}

std::string remedies_of(const std::vector<UnreachablePlace>& places) {
  std::vector<UnreachableCause> stated;
  std::string list;
  for (const UnreachablePlace& place : places) {
    const std::string remedy(remedy_of(place.cause));
    if (!remedy.empty() && std::find(stated.begin(), stated.end(), place.cause) == stated.end()) {
      stated.push_back(place.cause);
      list += (list.empty() ? "" : "; ") + remedy;
    }
  }
  return list;
}

}  // namespace seeker
