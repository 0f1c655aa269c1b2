#include "server/explore/horizon_views.hpp"

#include <algorithm>
#include <cmath>

#include "server/explore/view_gain.hpp"

namespace seeker::explore {
namespace {

/// Two views so near to each other show the same unknown floor.
constexpr double kSameFloor_m = 3.0;
/// More unknown floor than this is a guess, not a reason.
constexpr double kMostFloor_m2 = 8.0;
/// Cost of stopping and rotating, as a path length.
constexpr double kStop_m = 0.5;
/// Value of observing an opening at all, in unknown floor: every opening has to be observed at some time, however
/// little floor it shows.
constexpr double kSettled_m2 = 2.0;

/// From one place often more than one opening is well in view.
void note_shown(std::vector<HorizonView>& views, const PlaceInput& input, const ViewpointParams& params) {
  for (std::size_t k = 0; k < views.size(); ++k) {
    const Pose2& map_T_view = views[k].opening.map_T_view;
    for (std::size_t other = 0; other < views.size(); ++other) {
      if (other == k || well_in_view(views[other].opening, map_T_view, input.floor.occupancy, params)) {
        views[k].shows.push_back(other);
      }
    }
  }
}

}  // namespace

bool HorizonSequence::settles(std::size_t view) const {
  return std::find(settled.begin(), settled.end(), view) != settled.end();
}

std::vector<HorizonView> horizon_views(const PlaceInput& input, const SightScene& scene, const ExploreParams& params) {
  const auto count = std::min(input.openings.size(), static_cast<std::size_t>(params.viewpoints.max_candidates));
  std::vector<HorizonView> views;
  views.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Opening& opening = input.openings[k];
    HorizonView view;
    view.opening = opening;
    view.path_m = opening.cost;
    const ViewGain gain = view_gain(input.floor.cost, opening.map_T_view.translation(), params.one_step.sensor);
    view.floor_m2 = std::min(gain.area_m2, kMostFloor_m2);
    view.growth = scene.look(opening.map_T_view).growth();
    views.push_back(std::move(view));
  }
  note_shown(views, input, params.viewpoints);
  return views;
}

HorizonSequence extended(const HorizonSequence& sequence, const std::vector<HorizonView>& views, std::size_t view,
                         double path_m, double weight_path) {
  HorizonSequence longer = sequence;
  const HorizonView& added = views[view];
  double share = 1.0;
  for (const std::size_t stop : sequence.stops) {
    const double apart_m = distance_m(views[stop].opening.map_T_view, added.opening.map_T_view);
    share = std::min(share, apart_m / kSameFloor_m);
  }
  longer.stops.push_back(view);
  longer.path_m += path_m + kStop_m;
  const double discount = std::pow(longer.path_m, -weight_path);
  longer.floor_m2 += discount * share * added.floor_m2;
  for (const std::size_t shown : added.shows) {
    if (!longer.settles(shown)) {
      longer.settled.push_back(shown);
      longer.floor_m2 += discount * kSettled_m2;
    }
  }
  for (const EndForecast& end : added.growth.ends) {
    const auto known = std::find_if(longer.ends.begin(), longer.ends.end(),
                                    [&](const ExpectedEnd& other) { return other.end == end.end; });
    const ExpectedEnd expected{end.end, discount * end.extension_m, end.becomes_real ? discount : 0.0};
    if (known == longer.ends.end()) {
      longer.ends.push_back(expected);
    } else {
      known->extension_m = std::max(known->extension_m, expected.extension_m);
      known->becomes_real = std::max(known->becomes_real, expected.becomes_real);
    }
  }
  return longer;
}

}  // namespace seeker::explore
