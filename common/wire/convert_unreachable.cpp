#include <algorithm>

#include "common/wire/convert.hpp"

namespace seeker::wire {
namespace {

/// Unspecified on the wire is ours, and so is what this program does not know: the text still says it.
UnreachableCause cause_of(int value) {
  const bool known = value > 0 && value <= static_cast<int>(kUnreachableCauses.back());
  return known ? static_cast<UnreachableCause>(value) : UnreachableCause::kNotStated;
}

void read_place(const pb::UnreachablePlace& from, UnreachablePlace& to, Check& check) {
  read_required(from.has_place(), from.place(), to.p_map, "place", check);
  to.cause = cause_of(from.cause());
  to.size_m = check.finite("size_m", from.size_m());
  to.text = check.text("text", from.text());
}

}  // namespace

void write_unreachable(const std::vector<UnreachablePlace>& from, pb::MissionEnd* to) {
  write(positions_of(from), to->mutable_unreachable());
  const std::size_t count = std::min(from.size(), kMaxUnreachablePlaces);
  for (std::size_t k = 0; k < count; ++k) {
    pb::UnreachablePlace* place = to->add_unreachable_places();
    write(from[k].p_map, place->mutable_place());
    place->set_cause(static_cast<pb::UnreachableCause>(from[k].cause));
    place->set_size_m(from[k].size_m);
    place->set_text(clean_text(from[k].text));
  }
}

void read_unreachable(const pb::MissionEnd& from, std::vector<UnreachablePlace>& to, Check& check) {
  std::vector<Point2> points;
  {
    const auto scope = check.in("unreachable");
    read(from.unreachable(), points, check);
  }
  const auto described = static_cast<std::size_t>(from.unreachable_places_size());
  if (!check.count("unreachable_places", described, kMaxUnreachablePlaces)) {
    return;
  }
  to.resize(std::max(points.size(), described));
  for (std::size_t k = 0; k < to.size(); ++k) {
    if (k < described) {
      const auto scope = check.in("unreachable_places", k);
      read_place(from.unreachable_places(static_cast<int>(k)), to[k], check);
    } else {
      to[k].p_map = points[k];
    }
  }
}

}  // namespace seeker::wire
