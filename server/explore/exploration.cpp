#include "server/explore/exploration.hpp"

#include <utility>

#include "server/explore/exploration_impl.hpp"

namespace seeker::explore {
namespace {

Status validate(const nav::ForbiddenAreas& areas) {
  if (areas.bound) {
    if (const Status bound = validate_polygon(*areas.bound); !bound) {
      return fail_with_context("bound", bound.error());
    }
  }
  for (const Polygon& polygon : areas.keep_out) {
    if (const Status valid = validate_polygon(polygon); !valid) {
      return fail_with_context("keep-out area", valid.error());
    }
  }
  return {};
}

}  // namespace

Result<Exploration> Exploration::create(const ExploreRequest& request, const ExploreParams& params) {
  if (const Status valid = explore::validate(params); !valid) {
    return tl::unexpected(valid.error());
  }
  if (const Status valid = validate(request.areas); !valid) {
    return tl::unexpected(valid.error());
  }
  return Exploration(std::make_unique<Impl>(request, params, request.strategy(params)));
}

Exploration::Exploration(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Exploration::Exploration(Exploration&&) noexcept = default;
Exploration& Exploration::operator=(Exploration&&) noexcept = default;
Exploration::~Exploration() = default;

ExploreStep Exploration::step(const ExploreInput& input) { return impl_->step(input); }
void Exploration::resume(RobotTime now) { impl_->resume(now); }
void Exploration::transform(const MapMove& move) { impl_->transform(move); }
std::optional<ExploreEnd> Exploration::pending_end() const { return impl_->pending_end(); }
void Exploration::remember(const TopologyMemory& memory) { impl_->remember(memory); }
void Exploration::remember_start(const Point2& start_map) { impl_->remember_start(start_map); }
const ExploreStrategy& Exploration::strategy() const { return impl_->strategy(); }

}  // namespace seeker::explore
