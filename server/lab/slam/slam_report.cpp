#include "server/lab/slam/slam_report.hpp"

#include <algorithm>
#include <array>

#include "common/core/occupancy_tile.hpp"
#include "common/files/files.hpp"
#include "common/image/map_picture.hpp"
#include "common/image/png.hpp"
#include "server/lab/experiments/described_json.hpp"
#include "server/lab/experiments/table.hpp"

namespace seeker::lab {

// None of these may stand in an unnamed namespace: argument-dependent look-up would not find them from Fields.
void describe(config::Fields& f, QualityShare& share) {
  f.field("scans", share.scans);
  f.field("time_s", share.time_s);
}

void describe(config::Fields& f, QualitySpell& spell) {
  std::string quality(to_string(spell.quality));
  f.field("quality", quality);
  f.field("cause", spell.cause);
  f.field("from_s", spell.from_s);
  f.field("to_s", spell.to_s);
  f.field("scans", spell.scans);
}

void describe(config::Fields& f, TimeFigures& times) {
  f.field("mean_ms", times.mean_ms);
  f.field("median_ms", times.median_ms);
  f.field("p99_ms", times.p99_ms);
  f.field("max_ms", times.max_ms);
}

void describe(config::Fields& f, SlamCost& cost) {
  f.field("wall_s", cost.wall_s);
  f.field("processor_s", cost.processor_s);
  f.section("scan", cost.scan);
  f.section("scan_processor", cost.scan_processor);
  f.field("memory_empty_mb", cost.memory_empty_mb);
  f.field("memory_peak_mb", cost.memory_peak_mb);
}

namespace {

constexpr std::array kQualities = {LocalisationQuality::kLocalised, LocalisationQuality::kDegraded,
                                   LocalisationQuality::kLost, LocalisationQuality::kUnknown};
/// Spells and bad lines beyond this are counted, not listed.
constexpr std::size_t kMaxListed = 200;

/// What goes into report.json, in its order.
struct Report {
  std::string log;
  std::string robot_file;
  std::string estimator;
  std::uint64_t scans = 0;
  double duration_s = 0.0;
  bool times_invented = false;  // the log's own stamps were too coarse
  double path_m = 0.0;
  SlamCost cost;
  std::vector<std::pair<std::string, QualityShare>> quality;
  std::vector<QualitySpell> spells;
  std::uint64_t segments = 0;
  std::uint64_t keyframes = 0;
  std::uint64_t loops = 0;
  std::uint64_t refused = 0;
  std::string first_refusal;
  std::uint64_t bad_lines = 0;
  std::vector<std::string> bad_examples;
  std::string damage;
};

void describe(config::Fields& f, Report& report) {
  f.field("log", report.log);
  f.field("robot_file", report.robot_file);
  f.field("estimator", report.estimator);
  f.field("scans", report.scans);
  f.field("duration_s", report.duration_s);
  f.field("times_invented", report.times_invented);
  f.field("path_m", report.path_m);
  f.section("cost", report.cost);
  for (auto& [name, share] : report.quality) {
    f.section(name, share);
  }
  f.list("spells", report.spells);
  f.field("segments", report.segments);
  f.field("keyframes", report.keyframes);
  f.field("loops", report.loops);
  f.field("refused", report.refused);
  f.field("first_refusal", report.first_refusal);
  f.field("bad_lines", report.bad_lines);
  f.field("bad_examples", report.bad_examples);
  f.field("damage", report.damage);
}

Report report_of(const SlamSource& source, const SlamRun& run) {
  Report report;
  report.log = source.log.filename().string();
  report.robot_file = source.robot_file.filename().string();
  report.estimator = source.estimator;
  report.scans = run.online.size();
  report.duration_s = run.log.duration_s;
  report.times_invented = run.log.invented_period_s.has_value();
  report.path_m = length_m(run.trajectory);
  report.cost = run.cost;
  for (const LocalisationQuality quality : kQualities) {
    report.quality.emplace_back(to_string(quality), share_of(run, quality));
  }
  report.spells.assign(run.spells.begin(),
                       run.spells.begin() + static_cast<std::ptrdiff_t>(std::min(run.spells.size(), kMaxListed)));
  report.segments = run.segments.size();
  report.keyframes = run.keyframes;
  report.loops = run.loops;
  report.refused = run.refused;
  report.first_refusal = run.first_refusal;
  report.bad_lines = run.log.bad;
  for (const drivers::BadLine& bad : run.log.examples) {
    report.bad_examples.push_back("line " + std::to_string(bad.number) + ": " + bad.reason);
  }
  report.damage = run.log.damage;
  return report;
}

std::vector<std::pair<std::string, std::string>> facts_of(const SlamSource& source, const SlamRun& run) {
  const SlamCost& cost = run.cost;
  std::vector<std::pair<std::string, std::string>> facts = {
      {"log", source.log.filename().string()},
      {"robot file", source.robot_file.filename().string()},
      {"estimator", source.estimator},
      {"scans", std::to_string(run.online.size()) + " in " + fixed(run.log.duration_s, 1) + " s" +
                    (run.log.invented_period_s ? ", times invented: the log's stamps are too coarse" : "")},
      {"path", fixed(length_m(run.trajectory), 1) + " m"},
      {"wall time", fixed(cost.wall_s, 2) + " s (processor " + fixed(cost.processor_s, 2) + " s)"},
      {"ms per scan", fixed(cost.scan.mean_ms, 3) + ", median " + fixed(cost.scan.median_ms, 3)},
      {"p99, max ms", fixed(cost.scan.p99_ms, 3) + ", " + fixed(cost.scan.max_ms, 3)},
      {"processor ms", fixed(cost.scan_processor.mean_ms, 3) + ", p99 " + fixed(cost.scan_processor.p99_ms, 3)},
      {"memory", fixed(cost.memory_peak_mb, 1) + " MB (empty " + fixed(cost.memory_empty_mb, 1) + ")"}};
  if (!run.segments.empty() || run.keyframes > 0) {
    facts.emplace_back("segments", std::to_string(run.segments.size()));
    facts.emplace_back("kept scans", std::to_string(run.keyframes));
    facts.emplace_back("loops", std::to_string(run.loops));
  }
  for (const LocalisationQuality quality : kQualities) {
    if (const QualityShare share = share_of(run, quality); share.scans > 0) {
      facts.emplace_back(to_string(quality), std::to_string(share.scans) + " scans, " + fixed(share.time_s, 1) + " s");
    }
  }
  return facts;
}

}  // namespace

std::string slam_json(const SlamSource& source, const SlamRun& run) { return to_json(report_of(source, run)); }

std::string slam_text(const SlamSource& source, const SlamRun& run) {
  std::string text;
  for (const auto& [name, value] : facts_of(source, run)) {
    constexpr std::size_t kColumn = 14;
    text += name + std::string(kColumn - std::min(kColumn - 1, name.size()), ' ') + value + "\n";
  }
  if (run.refused > 0) {
    text += std::to_string(run.refused) + " calls were refused (first: " + run.first_refusal + ")\n";
  }
  if (run.log.bad > 0 || !run.log.damage.empty()) {
    text += drivers::describe(run.log) + "\n";
  }
  return text;
}

Result<std::optional<Grid<std::uint8_t>>> slam_occupancy(const SlamSource& source, const SlamRun& run) {
  nav::OccupancyMap map(source.occupancy);
  // A map that is full still takes what lies inside it; the picture shows that.
  const Status drawn =
      for_each_scan(source.log, source.geometry, run.trajectory,
                    [&map](const LaserScan& scan, const Pose2& map_T_base) { (void)map.integrate(scan, map_T_base); });
  if (!drawn) {
    return tl::unexpected<Error>(drawn.error());
  }
  return map.snapshot();
}

Result<Image> slam_picture(const SlamSource& source, const SlamRun& run,
                           const std::optional<Grid<std::uint8_t>>& occupancy) {
  image::MapScene scene;
  scene.title = source.log.filename().string();
  scene.facts = facts_of(source, run);
  scene.occupancy = occupancy;
  for (const StampedPose& pose : run.trajectory) {
    scene.trajectory.push_back(pose.map_T_base);
  }
  return image::draw_map(scene);
}

std::string walls_csv(const SlamRun& run, const std::optional<Grid<std::uint8_t>>& occupancy) {
  constexpr int kDigits = 4;
  std::string text;
  if (!run.segments.empty()) {
    text = "# x1,y1,x2,y2\n";
    for (const MapSegment& segment : run.segments) {
      const Point2 a = segment.left();
      const Point2 b = segment.right();
      text += fixed(a.x(), kDigits) + "," + fixed(a.y(), kDigits) + "," + fixed(b.x(), kDigits) + "," +
              fixed(b.y(), kDigits) + "\n";
    }
    return text;
  }
  constexpr double kWall = 0.65 * kOccupiedCell;
  text = "# x,y\n";
  for (std::size_t k = 0; occupancy && k < occupancy->cells().size(); ++k) {
    const std::uint8_t value = occupancy->cells()[k];
    if (value != kUnknownCell && value > kWall) {
      const Point2 centre = occupancy->frame().centre_of(occupancy->cell(k));
      text += fixed(centre.x(), kDigits) + "," + fixed(centre.y(), kDigits) + "\n";
    }
  }
  return text;
}

Status save_slam(const std::filesystem::path& folder, const SlamSource& source, const SlamRun& run) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    return fail(Errc::kIo, "cannot make the folder " + folder.string() + ": " + error.message());
  }
  const auto occupancy = slam_occupancy(source, run);
  const Result<Image> picture =
      occupancy ? slam_picture(source, run, *occupancy) : Result<Image>(tl::unexpected<Error>(occupancy.error()));
  if (!picture) {
    return tl::unexpected<Error>(picture.error());
  }
  std::vector<std::pair<std::string, std::string>> texts = {{"trajectory.tum", tum_text(run.trajectory)},
                                                            {"report.json", slam_json(source, run)},
                                                            {"walls.csv", walls_csv(run, *occupancy)}};
  if (run.trajectory != run.online) {
    texts.emplace_back("trajectory_online.tum", tum_text(run.online));
  }
  for (const auto& [name, text] : texts) {
    if (Status ok = files::write_file(folder / name, std::string_view(text)); !ok) {
      return ok;
    }
  }
  return image::write_png(folder / "map.png", *picture);
}

}  // namespace seeker::lab
