#include "server/app/loop/line_reporter.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::app {
namespace {

api::ScanLine reported(const lines::Line& line) {
  return {.normal_rad = line.alpha_rad,
          .start_rad = line.start_rad,
          .end_rad = line.end_rad,
          .distance_m = line.r_m,
          .length_m = line.length_m,
          .slope = line.slope,
          .intercept_m = line.intercept_m,
          .start = line.start,
          .end = line.end,
          .points = line.points,
          .fit_error_m = line.rms_m,
          .distance_sigma_m = std::sqrt(std::max(0.0, line.covariance(0, 0))),
          .normal_sigma_rad = std::sqrt(std::max(0.0, line.covariance(1, 1)))};
}

api::LinePacket reported(const lines::PacketHistory& history) {
  api::LinePacket packet{.first_beam = static_cast<std::uint32_t>(history.first_beam),
                         .last_beam = static_cast<std::uint32_t>(history.last_beam),
                         .rounds = {}};
  for (std::size_t k = 0; k < history.rounds.size(); ++k) {
    packet.rounds.push_back({history.rounds[k].gap_m, history.rounds[k].corner_m, history.worst_error_m[k]});
  }
  return packet;
}

}  // namespace

LineReporter::LineReporter(const lines::ExtractorParams& params)
    : kind_(params.kind), extractor_(lines::make_extractor(params)) {}

api::LineReport LineReporter::report(const LaserScan& scan) {
  extractor_->extract(scan, found_);
  api::LineReport report{.extractor = std::string(lines::to_string(kind_)),
                         .scan = scan,
                         .lines = {},
                         .range_sigma_m = found_.range_sigma_m,
                         .packets = {}};
  for (const lines::Line& line : found_.lines) {
    report.lines.push_back(reported(line));
  }
  for (const lines::PacketHistory& history : found_.history) {
    report.packets.push_back(reported(history));
  }
  return report;
}

}  // namespace seeker::app
