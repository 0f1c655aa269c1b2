#include <algorithm>

#include "common/wire/convert.hpp"

namespace seeker::wire {
namespace {

/// A scan of 8192 beams has no more lines, and no more packets; the paper's detector ends after 9 rounds.
constexpr std::size_t kMaxLines = kMaxScanBeams;
constexpr std::size_t kMaxRounds = 64;

void write_line(const api::ScanLine& from, pb::ScanLine* to) {
  to->set_normal_rad(from.normal_rad);
  to->set_start_rad(from.start_rad);
  to->set_end_rad(from.end_rad);
  to->set_distance_m(from.distance_m);
  to->set_length_m(from.length_m);
  if (from.slope) {
    to->set_slope(*from.slope);
  }
  if (from.intercept_m) {
    to->set_intercept_m(*from.intercept_m);
  }
  write(from.start, to->mutable_start());
  write(from.end, to->mutable_end());
  to->set_points(static_cast<std::uint32_t>(from.points));
  to->set_fit_error_m(from.fit_error_m);
  to->set_distance_sigma_m(from.distance_sigma_m);
  to->set_normal_sigma_rad(from.normal_sigma_rad);
}

void read_line(const pb::ScanLine& from, api::ScanLine& to, Check& check) {
  to.normal_rad = check.finite("normal_rad", from.normal_rad());
  to.start_rad = check.finite("start_rad", from.start_rad());
  to.end_rad = check.finite("end_rad", from.end_rad());
  to.distance_m = check.finite("distance_m", from.distance_m());
  to.length_m = check.finite("length_m", from.length_m());
  if (from.has_slope()) {
    to.slope = check.finite("slope", from.slope());
  }
  if (from.has_intercept_m()) {
    to.intercept_m = check.finite("intercept_m", from.intercept_m());
  }
  read_required(from.has_start(), from.start(), to.start, "start", check);
  read_required(from.has_end(), from.end(), to.end, "end", check);
  to.points = check.natural("points", from.points());
  to.fit_error_m = check.finite("fit_error_m", from.fit_error_m());
  to.distance_sigma_m = check.finite("distance_sigma_m", from.distance_sigma_m());
  to.normal_sigma_rad = check.finite("normal_sigma_rad", from.normal_sigma_rad());
}

void write_packet(const api::LinePacket& from, pb::LinePacket* to) {
  to->set_first_beam(from.first_beam);
  to->set_last_beam(from.last_beam);
  for (std::size_t k = 0; k < std::min(from.rounds.size(), kMaxRounds); ++k) {
    pb::LineRound* one = to->add_rounds();
    one->set_gap_m(from.rounds[k].gap_m);
    one->set_corner_m(from.rounds[k].corner_m);
    one->set_worst_error_m(from.rounds[k].worst_error_m);
  }
}

void read_packet(const pb::LinePacket& from, api::LinePacket& to, Check& check) {
  if (!check.count("rounds", static_cast<std::size_t>(from.rounds_size()), kMaxRounds)) {
    return;
  }
  to.first_beam = from.first_beam();
  to.last_beam = from.last_beam();
  for (int k = 0; k < from.rounds_size(); ++k) {
    const auto scope = check.in("rounds", static_cast<std::size_t>(k));
    const pb::LineRound& one = from.rounds(k);
    to.rounds.push_back({check.finite("gap_m", one.gap_m()), check.finite("corner_m", one.corner_m()),
                         check.finite("worst_error_m", one.worst_error_m())});
  }
}

}  // namespace

void write(const api::LineReport& from, pb::LineReport* to) {
  to->set_extractor(clean_text(from.extractor, kMaxNameBytes));
  write(from.scan, to->mutable_scan());
  for (std::size_t k = 0; k < std::min(from.lines.size(), kMaxLines); ++k) {
    write_line(from.lines[k], to->add_lines());
  }
  to->set_range_sigma_m(from.range_sigma_m);
  for (std::size_t k = 0; k < std::min(from.packets.size(), kMaxLines); ++k) {
    write_packet(from.packets[k], to->add_packets());
  }
}

void read(const pb::LineReport& from, api::LineReport& to, Check& check) {
  if (!check.count("lines", static_cast<std::size_t>(from.lines_size()), kMaxLines) ||
      !check.count("packets", static_cast<std::size_t>(from.packets_size()), kMaxLines)) {
    return;
  }
  to.extractor = check.text("extractor", from.extractor(), kMaxNameBytes);
  read_required(from.has_scan(), from.scan(), to.scan, "scan", check);
  for (int k = 0; k < from.lines_size(); ++k) {
    const auto scope = check.in("lines", static_cast<std::size_t>(k));
    read_line(from.lines(k), to.lines.emplace_back(), check);
  }
  to.range_sigma_m = check.finite("range_sigma_m", from.range_sigma_m());
  for (int k = 0; k < from.packets_size(); ++k) {
    const auto scope = check.in("packets", static_cast<std::size_t>(k));
    read_packet(from.packets(k), to.packets.emplace_back(), check);
  }
}

}  // namespace seeker::wire
