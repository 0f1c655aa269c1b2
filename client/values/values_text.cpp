#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "client/values/values.hpp"
#include "common/core/angle.hpp"

namespace seeker::cli {
namespace {

std::string text_of_mission(const api::MissionStatus& mission) {
  std::string text = mission.kind + " " + mission.id + " " + std::string(to_string(mission.state));
  if (mission.end) {
    return text + " " + std::string(to_string(mission.end->outcome)) + ": " + mission.end->cause;
  }
  return text + " " + fixed("%.0f %% ", 100.0 * mission.progress) + mission.phase +
         (mission.activity.empty() ? "" : ": " + mission.activity) +
         (mission.decision ? "; " + text_of(*mission.decision) : "");
}

struct Describe {
  std::string operator()(const api::RobotStatus& s) const {
    return place_text(s.pose) + " " + std::string(to_string(s.pose.quality)) + fixed("  %.2f m/s", s.velocity.v_m_s) +
           (s.estop ? "  ESTOP" : "") + (s.faults.empty() ? "" : "  fault: " + s.faults.front().message) +
           (s.mission && !s.mission->end ? "  " + text_of_mission(*s.mission) : "") +
           (s.link_countdown ? "  its client is " + text_of(*s.link_countdown) : "");
  }
  std::string operator()(const LaserScan& scan) const {
    const auto returns =
        std::count_if(scan.ranges_m.begin(), scan.ranges_m.end(), [](float r) { return std::isfinite(r); });
    return std::to_string(returns) + " of " + std::to_string(scan.ranges_m.size()) + " beams came back";
  }
  std::string operator()(const SonarScan& sonar) const {
    std::string text;
    for (const SonarReading& reading : sonar.readings) {
      text += std::isfinite(reading.range_m) ? fixed("%.2f ", static_cast<double>(reading.range_m)) : "- ";
    }
    return text + "m";
  }
  std::string operator()(const api::TileUpdate& tiles) const {
    return count_of(tiles.tiles.size(), "tile") + ", revision " + std::to_string(tiles.revision);
  }
  std::string operator()(const api::GridReport& grid) const {
    return count_of(grid.lists.searched.size(), "cell") + " searched, " + std::to_string(grid.lists.unsearched.size()) +
           " to go, " + text_of(grid.evidence.summary);
  }
  std::string operator()(const api::ImageFrame& image) const {
    return image.camera + " " + std::to_string(image.frame.image.width_px()) + "x" +
           std::to_string(image.frame.image.height_px());
  }
  std::string operator()(const api::MissionStatus& mission) const { return text_of_mission(mission); }
  std::string operator()(const api::Event& event) const {
    return std::string(to_string(event.severity)) + " " + event.kind + ": " + event.text;
  }
  std::string operator()(const api::SegmentUpdate& update) const {
    return (update.full ? "all: " : "") + count_of(update.changed.size(), "segment") + " changed, " +
           std::to_string(update.removed.size()) + " removed, revision " + std::to_string(update.revision);
  }
  std::string operator()(const api::LineReport& report) const {
    return count_of(report.lines.size(), "line") + " by " + report.extractor;
  }
  std::string operator()(const RobotTopology& robot) const { return text_of(robot); }
  std::string operator()(const api::Detection& detection) const {
    return (detection.withdrawn ? "withdrawn: " : "") + text_of(detection);
  }
};

}  // namespace

std::string fixed(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

std::string date_of(std::int64_t unix_s) {
  const auto time = static_cast<std::time_t>(unix_s);
  std::tm parts{};
  std::array<char, 32> text{};
  if (unix_s <= 0 || gmtime_r(&time, &parts) == nullptr ||
      std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", &parts) == 0) {
    return "-";
  }
  return text.data();
}

std::string count_of(std::uint64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string size_of(std::uint64_t bytes) { return fixed("%.1f kB", static_cast<double>(bytes) / 1000.0); }

std::string text_of(const Point2& p) { return "(" + fixed("%.2f, ", p.x()) + fixed("%.2f)", p.y()); }

std::string text_of(const Pose2& pose) {
  return text_of(pose.translation()) + " m, " + fixed("%.0f deg", rad_to_deg(pose.theta_rad));
}

std::string text_of(const RobotTopology& robot) {
  std::size_t goals = 0;
  for (const TopologyNode& node : robot.topology.nodes) {
    goals += node.goals.size();
  }
  return count_of(robot.topology.nodes.size(), "node") + ", " + count_of(robot.topology.edges.size(), "edge") + ", " +
         count_of(goals, "goal") + (robot.target_map ? ", drives to " + text_of(*robot.target_map) + " m" : "");
}

std::string place_text(const PoseEstimate& pose) {
  return is_placed(pose.quality) ? text_of(pose.map_T_base) : "not known in the map";
}

double sigma_m(const Matrix2& c) {
  const double mean = (c(0, 0) + c(1, 1)) / 2.0;
  return std::sqrt(std::max(0.0, mean + std::hypot((c(0, 0) - c(1, 1)) / 2.0, c(0, 1))));
}

std::string text_of(const api::Detection& detection) {
  std::string text = detection.target;
  if (detection.position) {
    text += " at " + text_of(*detection.position) +
            fixed(" m \xC2\xB1 %.2f m", sigma_m(detection.position_covariance)) + ", range from " +
            std::string(to_string(detection.range_source));
  } else {
    text += ", bearing only";
  }
  return text + fixed(", bearing %.1f deg", rad_to_deg(detection.bearing_map_rad)) + " from " +
         text_of(detection.map_T_base.translation()) + fixed(", score %.2f", detection.score) + ", " +
         count_of(detection.sightings, "sighting");
}

std::string text_of(const api::CoverageSummary& coverage) {
  const double share =
      coverage.reachable_area_m2 > 0.0 ? 100.0 * coverage.covered_area_m2 / coverage.reachable_area_m2 : 0.0;
  return fixed("%.1f of ", coverage.covered_area_m2) + fixed("%.1f m\xC2\xB2 ", coverage.reachable_area_m2) +
         fixed("(%.0f %%) with probability ", share) + fixed("%.2f or more, ", coverage.threshold) +
         fixed("mean %.2f", coverage.mean_probability);
}

std::vector<image::GapMark> marks_of(const std::vector<api::Gap>& gaps) {
  std::vector<image::GapMark> marks;
  marks.reserve(gaps.size());
  for (const api::Gap& gap : gaps) {
    marks.push_back({gap.centre, gap.area_m2, gap.reason});
  }
  return marks;
}

std::vector<std::string> lines_of(const std::vector<api::Gap>& gaps) {
  std::vector<std::string> lines;
  for (const image::GapMark& gap : image::listed_gaps(marks_of(gaps))) {
    lines.push_back(std::to_string(lines.size() + 1) + "  " + fixed("%.1f m\xC2\xB2 at ", gap.area_m2) +
                    text_of(gap.centre) + " " + gap.reason);
  }
  return lines;
}

std::string text_of(const ExploreDecision& decision) {
  const auto available = std::count_if(decision.candidates.begin(), decision.candidates.end(),
                                       [](const DecisionCandidate& c) { return c.refused.empty(); });
  return "decision " + std::to_string(decision.number) + " (" + decision.rule + ", " + std::to_string(available) +
         " of " + std::to_string(decision.candidates.size()) + " candidates open): " + decision.why;
}

std::string text_of(const api::Update& update) {
  std::string name(to_string(update.topic));
  constexpr std::size_t kColumn = 10;
  name.resize(kColumn, ' ');
  return fixed("%9.2f s  ", to_seconds(update.stamp)) + name + std::visit(Describe{}, update.payload) +
         (update.dropped > 0 ? " (" + std::to_string(update.dropped) + " left out)" : "");
}

std::string text_of(const api::LeaseState& lease) {
  if (lease.owner.empty()) {
    return "nobody";
  }
  std::string text = lease.owner + (lease.stale ? ", not heard: others may acquire it" : "");
  if (!lease.requested_by.empty()) {
    text += "; '" + lease.requested_by + "' asks for it, " + fixed("%.0f s to answer", to_seconds(lease.request_left));
  }
  return text;
}

std::string text_of(const api::LinkSteps& steps, api::LinkPolicy short_form) {
  std::string text;
  for (const api::LinkStep& step : steps) {
    text += (text.empty() ? "" : ", ") + std::string(to_string(step.action)) +
            fixed(" after %.4g s", to_seconds(step.after));
  }
  return text.empty() ? std::string(to_string(short_form)) : text;
}

std::string text_of(const api::LinkCountdown& countdown) {
  return fixed("silent for %.0f s", to_seconds(countdown.silent)) +
         (countdown.next
              ? ", " + std::string(to_string(countdown.next->action)) + fixed(" in %.0f s", to_seconds(countdown.left))
              : "");
}

}  // namespace seeker::cli
