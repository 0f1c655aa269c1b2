#include "server/search/search_mission.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "server/search/search_mission_impl.hpp"

namespace seeker::search {

Result<SearchMission> SearchMission::create(const SearchRequest& request, const SearchParams& params,
                                            const std::shared_ptr<const ControlTable>& table) {
  if (const Status valid = validate(request); !valid) {
    return tl::unexpected(valid.error());
  }
  if (const Status valid = validate(params); !valid) {
    return tl::unexpected(valid.error());
  }
  if (table == nullptr) {
    return fail(Errc::kInvalidArgument, "a search needs the local planner's control table; create one first");
  }
  return SearchMission(std::make_unique<Impl>(request, params, table));
}

SearchMission::SearchMission(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SearchMission::SearchMission(SearchMission&&) noexcept = default;
SearchMission& SearchMission::operator=(SearchMission&&) noexcept = default;
SearchMission::~SearchMission() = default;

SearchStep SearchMission::step(const SearchInput& input) { return impl_->step(input); }

void SearchMission::on_sightings(RobotTime stamp, const Pose2& map_T_base_at_exposure,
                                 const std::vector<vision::Sighting>& sightings, const LaserScan* laser,
                                 const SonarScan* sonar) {
  on_looks({{stamp, map_T_base_at_exposure, Matrix3::Zero(), sightings, laser, sonar}});
}

void SearchMission::on_looks(std::vector<Look> looks) {
  for (Look& look : looks) {
    look.pose_covariance = impl_->pose_covariance_;
  }
  impl_->add_looks(looks);
}

// The clock stops with the last step; resume() makes up for what passed.
void SearchMission::pause() { impl_->visit_.interrupted(); }
void SearchMission::resume(RobotTime now) { impl_->resume(now); }
void SearchMission::transform(const MapMove& move) { impl_->transform(move); }
void SearchMission::keep_evidence(EvidenceGrid evidence) {
  impl_->evidence_ = std::move(evidence);
  impl_->evidence_.set_others({});
}

const EvidenceGrid& SearchMission::evidence() const { return impl_->evidence_; }

void SearchMission::set_others(const std::vector<SearchedFloor>& others) {
  std::vector<SearchedFloor> same;
  std::copy_if(others.begin(), others.end(), std::back_inserter(same), [&](const SearchedFloor& other) {
    return std::all_of(request().targets.begin(), request().targets.end(), [&](const SearchTarget& target) {
      return std::find(other.targets.begin(), other.targets.end(), target.name) != other.targets.end();
    });
  });
  impl_->evidence_.set_others(same);
}
void SearchMission::take_back(const Grid<std::uint8_t>& looks, const GridLists& lists) {
  impl_->evidence_.take_back(looks);
  impl_->strategy_->take_back(lists);
}
const GridLists& SearchMission::lists() const { return impl_->strategy_->lists(); }
std::vector<Detection> SearchMission::detections() const { return impl_->tracker_.detections(); }
EvidenceReport SearchMission::evidence_report() const { return impl_->evidence_report(); }
CoverageSummary SearchMission::summary() const { return impl_->summary_; }
double SearchMission::path_length_m() const { return impl_->path_length_m_; }
const SearchRequest& SearchMission::request() const { return impl_->request_; }

double SearchMission::progress() const {
  const CoverageSummary& s = impl_->summary_;
  return s.reachable_area_m2 > 0.0 ? s.covered_area_m2 / s.reachable_area_m2 : 0.0;
}

}  // namespace seeker::search
