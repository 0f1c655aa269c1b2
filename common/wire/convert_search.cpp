#include "common/wire/convert.hpp"
#include "common/wire/zstd.hpp"

namespace seeker::wire {
namespace {

void write(const Matrix2& from, pb::Covariance2* to) {
  to->set_xx_m2(from(0, 0));
  to->set_xy_m2(from(0, 1));
  to->set_yy_m2(from(1, 1));
}

void read(const pb::Covariance2& from, Matrix2& to, Check& check) {
  const double xy = check.finite("xy_m2", from.xy_m2());
  to << check.finite("xx_m2", from.xx_m2()), xy, xy, check.finite("yy_m2", from.yy_m2());
}

void write(const api::EvidenceMap& from, pb::EvidenceMap* to) {
  wire::write(from.probability, to->mutable_probability());
  for (std::size_t k = 0; k < std::min(from.gaps.size(), kMaxGaps); ++k) {
    pb::Gap* gap = to->add_gaps();
    wire::write(from.gaps[k].centre, gap->mutable_centre());
    gap->set_area_m2(from.gaps[k].area_m2);
    gap->set_reason(clean_text(from.gaps[k].reason));
  }
  wire::write(from.summary, to->mutable_summary());
  to->set_map_epoch(from.map_epoch);
}

void read(const pb::EvidenceMap& from, api::EvidenceMap& to, Check& check) {
  if (!check.count("gaps", static_cast<std::size_t>(from.gaps_size()), kMaxGaps) ||
      !check.require("probability", from.has_probability())) {
    return;
  }
  {
    const auto scope = check.in("probability");
    wire::read(from.probability(), to.probability, check);
  }
  to.gaps.resize(static_cast<std::size_t>(from.gaps_size()));
  for (std::size_t k = 0; k < to.gaps.size(); ++k) {
    const auto scope = check.in("gaps", k);
    const pb::Gap& gap = from.gaps(static_cast<int>(k));
    read_required(gap.has_centre(), gap.centre(), to.gaps[k].centre, "centre", check);
    to.gaps[k].area_m2 = check.finite("area_m2", gap.area_m2());
    to.gaps[k].reason = check.text("reason", gap.reason());
  }
  read_required(from.has_summary(), from.summary(), to.summary, "summary", check);
  to.map_epoch = from.map_epoch();
}

}  // namespace

void write(const api::GridLists& from, pb::GridLists* to) {
  to->set_cell_size_m(from.cell_size_m);
  write(from.searched, to->mutable_searched());
  write(from.unsearched, to->mutable_unsearched());
  write(from.unreachable, to->mutable_unreachable());
  to->set_passes_n(static_cast<std::uint32_t>(from.passes_n));
  to->set_passes_limit_n(static_cast<std::uint32_t>(from.passes_limit_n));
}

void read(const pb::GridLists& from, api::GridLists& to, Check& check) {
  to.cell_size_m = check.finite("cell_size_m", from.cell_size_m());
  {
    const auto scope = check.in("searched");
    read(from.searched(), to.searched, check);
  }
  {
    const auto scope = check.in("unsearched");
    read(from.unsearched(), to.unsearched, check);
  }
  {
    const auto scope = check.in("unreachable");
    read(from.unreachable(), to.unreachable, check);
  }
  to.passes_n = check.natural("passes_n", from.passes_n());
  to.passes_limit_n = check.natural("passes_limit_n", from.passes_limit_n());
}

void write(const Grid<std::uint8_t>& from, pb::ByteGrid* to) {
  to->set_origin_x_m(from.frame().origin.x());
  to->set_origin_y_m(from.frame().origin.y());
  to->set_resolution_m(from.frame().resolution_m);
  to->set_width(static_cast<std::uint32_t>(from.width()));
  to->set_height(static_cast<std::uint32_t>(from.height()));
  to->set_cells_zstd(compress(from.cells()));
}

void read(const pb::ByteGrid& from, Grid<std::uint8_t>& to, Check& check) {
  const std::uint64_t cells = std::uint64_t{from.width()} * from.height();
  if (from.width() > kMaxGridCells || from.height() > kMaxGridCells || cells > kMaxGridCells) {
    check.refuse("width", Errc::kTooLarge, "* height is above 8 Mi cells");
    return;
  }
  GridFrame frame;
  frame.origin = {check.finite("origin_x_m", from.origin_x_m()), check.finite("origin_y_m", from.origin_y_m())};
  frame.resolution_m = check.finite("resolution_m", from.resolution_m());
  if (!(frame.resolution_m > 0.0)) {
    check.refuse("resolution_m", Errc::kInvalidArgument, "must be above zero");
    return;
  }
  to = Grid<std::uint8_t>(frame, static_cast<int>(from.width()), static_cast<int>(from.height()));
  if (const Status unpacked = decompress(from.cells_zstd(), to.cells()); !unpacked) {
    check.refuse("cells_zstd", unpacked.error().code, unpacked.error().message);
  }
}

void write(const api::CoverageSummary& from, pb::CoverageSummary* to) {
  to->set_reachable_area_m2(from.reachable_area_m2);
  to->set_covered_area_m2(from.covered_area_m2);
  to->set_threshold(from.threshold);
  to->set_mean_probability(from.mean_probability);
  to->set_gaps(static_cast<std::uint32_t>(from.gaps));
}

void read(const pb::CoverageSummary& from, api::CoverageSummary& to, Check& check) {
  to.reachable_area_m2 = check.finite("reachable_area_m2", from.reachable_area_m2());
  to.covered_area_m2 = check.finite("covered_area_m2", from.covered_area_m2());
  to.threshold = check.finite("threshold", from.threshold());
  to.mean_probability = check.finite("mean_probability", from.mean_probability());
  to.gaps = check.natural("gaps", from.gaps());
}

void write(const api::Detection& from, pb::Detection* to) {
  to->set_id(from.id);
  to->set_target(clean_text(from.target, kMaxNameBytes));
  to->set_stamp_ns(from.stamp.time_since_epoch().count());
  to->set_u_px(from.u_px);
  to->set_v_px(from.v_px);
  to->set_score(from.score);
  write(from.map_T_base, to->mutable_map_t_base());
  to->set_bearing_base_rad(from.bearing_base_rad);
  to->set_bearing_map_rad(from.bearing_map_rad);
  if (from.position) {
    write(*from.position, to->mutable_position());
  }
  write(from.position_covariance, to->mutable_position_covariance());
  to->set_range_source(static_cast<pb::RangeSource>(wire_enum(from.range_source)));
  to->set_sightings(static_cast<std::uint32_t>(from.sightings));
  to->set_map_epoch(from.map_epoch);
  to->set_mission(clean_text(from.mission, kMaxNameBytes));
  to->set_withdrawn(from.withdrawn);
}

void read(const pb::Detection& from, api::Detection& to, Check& check) {
  to.id = from.id();
  to.target = check.text("target", from.target(), kMaxNameBytes);
  to.stamp = RobotTime(Duration(from.stamp_ns()));
  to.u_px = check.finite("u_px", from.u_px());
  to.v_px = check.finite("v_px", from.v_px());
  to.score = check.finite("score", from.score());
  read_required(from.has_map_t_base(), from.map_t_base(), to.map_T_base, "map_t_base", check);
  to.bearing_base_rad = check.finite("bearing_base_rad", from.bearing_base_rad());
  to.bearing_map_rad = check.finite("bearing_map_rad", from.bearing_map_rad());
  if (from.has_position()) {
    const auto scope = check.in("position");
    Point2 position = Point2::Zero();
    read(from.position(), position, check);
    to.position = position;
  }
  if (check.require("position_covariance", from.has_position_covariance())) {
    const auto scope = check.in("position_covariance");
    read(from.position_covariance(), to.position_covariance, check);
  }
  check.enumerator("range_source", from.range_source(), api::RangeSource::kFloor, to.range_source);
  to.sightings = check.natural("sightings", from.sightings());
  to.map_epoch = from.map_epoch();
  to.mission = check.text("mission", from.mission(), kMaxNameBytes);
  to.withdrawn = from.withdrawn();
}

void write(const api::GridReport& from, pb::GridReport* to) {
  write(from.lists, to->mutable_lists());
  write(from.evidence, to->mutable_evidence());
  to->set_map_epoch(from.map_epoch);
}

void read(const pb::GridReport& from, api::GridReport& to, Check& check) {
  if (!check.require("lists", from.has_lists()) || !check.require("evidence", from.has_evidence())) {
    return;
  }
  {
    const auto scope = check.in("lists");
    read(from.lists(), to.lists, check);
  }
  const auto scope = check.in("evidence");
  read(from.evidence(), to.evidence, check);
  to.map_epoch = from.map_epoch();
}

}  // namespace seeker::wire
