#include "server/app/fleet/known_others.hpp"

namespace seeker::app {

void KnownOthers::receive(api::FleetSightings sightings) {
  floor_ = floor_of(sightings.floor);
  searched_ = shared_list(std::move(sightings.searched), searched_);
  sides_ = shared_list(std::move(sightings.sides), sides_);
  news_.report(sightings.findings, host_);
}

void KnownOthers::receive(const Result<api::FleetShared>& shared) {
  std::optional<FleetView> view = view_;
  const api::FleetState state = shared ? shared->state : api::FleetState::kWaiting;
  switch (state) {
    case api::FleetState::kMerged: view = FleetView{robot_id_, shared->others, floor_, searched_, sides_}; break;
    case api::FleetState::kWaiting:
    case api::FleetState::kInsufficientOverlap:
      for (std::size_t k = 0; view && k < view->others.size(); ++k) {
        view->others[k].active = false;
        view->others[k].velocity.reset();
      }
      break;
    case api::FleetState::kAmbiguous:
    case api::FleetState::kContradicted:
    case api::FleetState::kSplit:
      view.reset();
      floor_.reset();
      searched_.reset();
      sides_.reset();
      break;
  }
  if (view != view_) {
    view_ = view;
    host_.take_view(std::move(view));
  }
}

}  // namespace seeker::app
