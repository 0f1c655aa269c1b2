#include "server/search/search_types.hpp"

namespace seeker::search {
namespace {

bool valid_size(double size_m) { return size_m > 0.0 && size_m <= kMaxTargetSize_m; }

Status validate_targets(const std::vector<SearchTarget>& targets) {
  if (targets.empty() || targets.size() > kMaxSearchTargets) {
    return fail(Errc::kInvalidArgument, "a search needs 1 to 16 targets; name what to look for");
  }
  for (const SearchTarget& target : targets) {
    const bool valid_depth = target.depth_m >= 0.0 && target.depth_m <= kMaxTargetSize_m;
    if (!valid_size(target.width_m) || !valid_size(target.height_m) || !valid_depth) {
      return fail(Errc::kInvalidArgument, "target '" + target.name + "' has a size outside 0..10 m; give it in metres");
    }
  }
  return {};
}

}  // namespace

std::string_view to_string(Strategy strategy) {
  switch (strategy) {
    case Strategy::kPaper: return "paper";
    case Strategy::kPlan: return "plan";
    case Strategy::kSpiral: return "spiral";
    case Strategy::kFrontier: return "frontier";
  }
  return "unknown";
}

std::string_view to_string(EndKind kind) {
  switch (kind) {
    case EndKind::kTargetFound: return "TARGET_FOUND";
    case EndKind::kNotFoundAreaCovered: return "NOT_FOUND_AREA_COVERED";
    case EndKind::kUnreachable: return "UNREACHABLE";
    case EndKind::kUncertain: return "UNCERTAIN";
  }
  return "UNKNOWN";
}

std::string_view to_string(RangeSource source) {
  switch (source) {
    case RangeSource::kNone: return "none";
    case RangeSource::kSonar: return "sonar";
    case RangeSource::kLidar: return "lidar";
    case RangeSource::kTriangulation: return "triangulation";
    case RangeSource::kFloor: return "floor";
  }
  return "unknown";
}

Status validate(const SearchRequest& request) {
  if (const Status targets = validate_targets(request.targets); !targets) {
    return targets;
  }
  if (request.areas.bound) {
    if (const Status bound = validate_polygon(*request.areas.bound); !bound) {
      return fail_with_context("bound", bound.error());
    }
  }
  for (const Polygon& area : request.areas.keep_out) {
    if (const Status keep_out = validate_polygon(area); !keep_out) {
      return fail_with_context("keep-out area", keep_out.error());
    }
  }
  return {};
}

}  // namespace seeker::search
