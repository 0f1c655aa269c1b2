#include <cmath>

#include "common/core/angle.hpp"
#include "common/core/occupancy_tile.hpp"
#include "common/image/canvas.hpp"
#include "common/image/map_layers.hpp"
#include "common/image/map_view.hpp"
#include "server/lab/experiments/described_json.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/map_merging/merge_command.hpp"
#include "server/nav/occupancy_map.hpp"

namespace seeker::lab {
namespace {

struct ReportHypothesis {
  Pose2 a_T_b;
  std::vector<double> covariance;
  fleet::MergeHypothesis figures;
  std::uint64_t pairs = 0;
  std::uint64_t deformation_dof = 0;
  double deformation_largest_deg = 0.0;
};

void describe(config::Fields& f, ReportHypothesis& h) {
  f.field("a_T_b", h.a_T_b);
  f.field("covariance", h.covariance);
  f.field("node_pairs", h.pairs);
  f.field("shared_wall_m", h.figures.shared_wall_m);
  f.field("weak_wall_m", h.figures.weak_wall_m);
  f.field("contradiction", h.figures.contradiction);
  f.field("denied_piece_m", h.figures.denied_piece_m);
  f.field("residual_m", h.figures.residual_m);
  f.field("deformation_chi2", h.figures.deformation.chi2);
  f.field("deformation_dof", h.deformation_dof);
  f.field("deformation_largest_m", h.figures.deformation.largest_m);
  f.field("deformation_largest_deg", h.deformation_largest_deg);
  f.field("confidence", h.figures.confidence);
}

struct ReportRefusal {
  std::uint64_t node_a = 0;
  std::uint64_t node_b = 0;
  std::string reason;
};

void describe(config::Fields& f, ReportRefusal& r) {
  f.field("node_a", r.node_a);
  f.field("node_b", r.node_b);
  f.field("reason", r.reason);
}

struct ReportPair {
  std::string a;
  std::string b;
  std::string verdict;
  std::string reason;
  std::uint64_t compared = 0;
  std::vector<ReportHypothesis> hypotheses;
  std::vector<ReportRefusal> rejected;
};

void describe(config::Fields& f, ReportPair& p) {
  f.field("a", p.a);
  f.field("b", p.b);
  f.field("verdict", p.verdict);
  f.field("reason", p.reason);
  f.field("compared", p.compared);
  f.list("hypotheses", p.hypotheses);
  f.list("rejected", p.rejected);
}

struct ReportRobot {
  std::string name;
  std::uint64_t nodes = 0;
  std::uint64_t keyframes = 0;
  bool joined = false;
  Pose2 joint_T_map;
};

void describe(config::Fields& f, ReportRobot& r) {
  f.field("log", r.name);
  f.field("nodes", r.nodes);
  f.field("keyframes", r.keyframes);
  f.field("joined", r.joined);
  f.field("joint_T_map", r.joint_T_map);
}

struct Report {
  std::vector<ReportRobot> robots;
  std::vector<ReportPair> pairs;
  std::uint64_t relations = 0;
  std::uint64_t switched_off = 0;
  double merge_s = 0.0;
  double join_s = 0.0;
};

void describe(config::Fields& f, Report& r) {
  f.list("robots", r.robots);
  f.list("pairs", r.pairs);
  f.field("relations", r.relations);
  f.field("switched_off", r.switched_off);
  f.field("merge_s", r.merge_s);
  f.field("join_s", r.join_s);
}

ReportPair report_of(const MergeRun& run, const fleet::PairAnswer& pair) {
  ReportPair report;
  report.a = run.logs[pair.slot_a].name;
  report.b = run.logs[pair.slot_b].name;
  report.verdict = to_string(pair.answer.verdict);
  report.reason = pair.answer.reason;
  report.compared = pair.answer.compared;
  for (const fleet::MergeHypothesis& h : pair.answer.hypotheses) {
    const Matrix3& c = h.a_T_b.covariance;
    report.hypotheses.push_back({h.a_T_b.a_T_b,
                                 {c.data(), c.data() + c.size()},
                                 h,
                                 h.pairs.size(),
                                 h.deformation.dof,
                                 rad_to_deg(h.deformation.largest_rad)});
  }
  for (const fleet::RejectedPair& r : pair.answer.rejected) {
    report.rejected.push_back({r.node_a, r.node_b, std::string(r.reason)});
  }
  return report;
}

Report report_of(const MergeRun& run) {
  Report report;
  for (std::size_t k = 0; k < run.logs.size(); ++k) {
    const MergedLog& log = run.logs[k];
    const auto joined = run.joint.robots.find(static_cast<std::uint8_t>(k));
    const bool is_joined = joined != run.joint.robots.end();
    report.robots.push_back({log.name, log.run.map.nodes.size(), log.run.map.keyframes.size(), is_joined,
                             is_joined ? joined->second.joint_T_map : Pose2{}});
  }
  for (const fleet::PairAnswer& pair : run.pairs) {
    report.pairs.push_back(report_of(run, pair));
  }
  report.relations = run.joint.pairs;
  report.switched_off = run.joint.switched_off.size();
  report.merge_s = run.merge_s;
  report.join_s = run.join_s;
  return report;
}

std::string pose_text(const Pose2& pose) {
  return fixed(pose.x_m, 3) + " m, " + fixed(pose.y_m, 3) + " m, " + fixed(rad_to_deg(pose.theta_rad), 2) + " deg";
}

std::string deformation_text(const fleet::Deformation& deformation) {
  return deformation.dof == 0 ? ", not deformed"
                              : ", deformed by up to " + fixed(deformation.largest_m, 2) + " m, " +
                                    fixed(rad_to_deg(deformation.largest_rad), 1) + " deg between neighbours (chi2 " +
                                    fixed(deformation.chi2, 0) + ", " + std::to_string(deformation.dof) + " dof)";
}

std::string hypothesis_text(const fleet::MergeHypothesis& h) {
  const Matrix3& c = h.a_T_b.covariance;
  return "  a_T_b " + pose_text(h.a_T_b.a_T_b) + " (sigma " + fixed(std::sqrt(c(0, 0)), 3) + ", " +
         fixed(std::sqrt(c(1, 1)), 3) + ", " + fixed(rad_to_deg(std::sqrt(c(2, 2))), 2) + "), confidence " +
         fixed(h.confidence, 2) + ": " + std::to_string(h.pairs.size()) + " node pairs, " + fixed(h.shared_wall_m, 1) +
         " m of shared wall (" + fixed(h.weak_wall_m, 1) + " m across), " + fixed(100.0 * h.contradiction, 1) +
         " % denied (" + fixed(h.denied_piece_m, 1) + " m in one piece), residual " + fixed(h.residual_m, 3) + " m" +
         deformation_text(h.deformation) + "\n";
}

}  // namespace

std::string merge_json(const MergeRun& run) { return to_json(report_of(run)); }

std::string merge_text(const MergeRun& run) {
  std::string text;
  for (const fleet::PairAnswer& pair : run.pairs) {
    text += run.logs[pair.slot_a].name + " and " + run.logs[pair.slot_b].name + ": " +
            std::string(to_string(pair.answer.verdict)) + ": " + pair.answer.reason + "\n";
    for (const fleet::MergeHypothesis& h : pair.answer.hypotheses) {
      text += hypothesis_text(h);
    }
    text += "  " + std::to_string(pair.answer.compared) + " comparisons, " +
            std::to_string(pair.answer.rejected.size()) + " refused\n";
  }
  for (const auto& [slot, robot] : run.joint.robots) {
    text += "joined: " + run.logs[slot].name + " at " + pose_text(robot.joint_T_map) + "\n";
  }
  text += std::to_string(run.joint.pairs) + " relations in the joint map, " +
          std::to_string(run.joint.switched_off.size()) + " switched off; merged in " + fixed(run.merge_s, 2) +
          " s, joined in " + fixed(run.join_s, 2) + " s\n";
  return text;
}

Result<Image> merge_picture(const MergeRun& run) {
  nav::OccupancyMap occupancy;
  std::map<std::uint32_t, Pose2> nodes;
  for (const MapNode& node : run.joint.map.nodes) {
    nodes[node.id] = node.map_T_node;
  }
  std::map<std::uint8_t, std::vector<Point2>> paths;
  for (const MapKeyframe& keyframe : run.joint.map.keyframes) {
    const Pose2 joint_T_base = nodes.at(keyframe.node) * keyframe.node_T_base;
    // A map that is full still takes what lies inside it; the picture shows that.
    (void)occupancy.integrate(unpack_scan(keyframe), joint_T_base);
    paths[fleet::origin_of_node(keyframe.node).slot].push_back(joint_T_base.translation());
  }
  image::MapScene scene;
  scene.occupancy = occupancy.snapshot();
  const Result<image::MapView> view = image::fit_view(scene, {});
  if (!view) {
    return tl::unexpected<Error>(view.error());
  }
  image::Canvas canvas(view->width_px, view->height_px, image::kWhite);
  if (scene.occupancy) {
    image::draw_occupancy(canvas, *view, *scene.occupancy);
  }
  constexpr double kText_px = 10.0;
  constexpr double kRow_px = 18.0;
  Point2 legend(kRow_px, kRow_px);
  for (auto& [slot, path] : paths) {
    for (Point2& p : path) {
      p = view->to_px(p);
    }
    const image::Colour colour = image::series_colour(slot);
    canvas.polyline(path, {colour, 2.0, image::LineStyle::kSolid, 0.9});
    canvas.text(legend, run.logs[slot].name, {.colour = colour, .size_px = kText_px, .halo = image::kWhite});
    legend.y() += kRow_px;
  }
  image::draw_scale_bar(canvas, *view);
  return canvas.image();
}

}  // namespace seeker::lab
