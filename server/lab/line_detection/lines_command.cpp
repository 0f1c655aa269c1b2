#include "server/lab/line_detection/lines_command.hpp"

#include <algorithm>
#include <cmath>

#include "common/image/png.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/lab/experiments/described_json.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/slam/plot_trajectories.hpp"
#include "server/lab/slam/robot_of_log.hpp"
#include "server/lab/slam/slam_report.hpp"

namespace seeker::lab {

// Not in an unnamed namespace: argument-dependent look-up would not find it from Fields.
void describe(config::Fields& f, LineStatistics& s) {
  f.field("extractor", s.extractor);
  f.field("scans", s.scans);
  f.field("beams", s.beams);
  f.field("lines", s.lines);
  f.field("lines_per_scan", s.lines_per_scan);
  f.field("most_lines", s.most_lines);
  f.field("points_on_lines", s.points_on_lines);
  f.field("range_sigma_m", s.range_sigma_m);
  f.section("scan", s.scan);
  f.section("scan_processor", s.scan_processor);
  f.field("bad_lines", s.bad_lines);
}

namespace {

void count_points(const LaserScan& scan, const lines::ScanLines& found, double& returns, double& on_lines) {
  for (const float range_m : scan.ranges_m) {
    returns += std::isfinite(range_m) ? 1.0 : 0.0;
  }
  for (const lines::Line& line : found.lines) {
    on_lines += line.points;
  }
}

/// Calls `visit` for every scan of the log until it returns false.
template <class Visit>
Result<drivers::ReplaySummary> walk(const std::filesystem::path& log, const drivers::ReplayParams& geometry,
                                    const Visit& visit) {
  const Result<std::shared_ptr<drivers::ReplaySource>> source = drivers::ReplaySource::open(log, geometry);
  if (!source) {
    return tl::unexpected<Error>(source.error());
  }
  while ((*source)->advance_one()) {
    const std::optional<LaserScan> scan = (*source)->take_scan();
    if (scan && !visit(*scan)) {
      break;
    }
  }
  return (*source)->summary();
}

std::string text_of(const LineStatistics& s) {
  Table table({"figure", "value"});
  table.add({"extractor", s.extractor});
  table.add({"scans", std::to_string(s.scans)});
  table.add({"beams", std::to_string(s.beams)});
  table.add({"lines per scan", fixed(s.lines_per_scan, 2)});
  table.add({"most lines", std::to_string(s.most_lines)});
  table.add({"returns on lines %", fixed(100.0 * s.points_on_lines, 1)});
  table.add({"range sigma mm", fixed(1e3 * s.range_sigma_m, 1)});
  constexpr double kMicro = 1e3;  // ms to us
  const auto add = [&](const std::string& name, const TimeFigures& t) {
    table.add({"mean, median " + name, fixed(kMicro * t.mean_ms, 2) + ", " + fixed(kMicro * t.median_ms, 2)});
    table.add({"p99, max " + name, fixed(kMicro * t.p99_ms, 2) + ", " + fixed(kMicro * t.max_ms, 2)});
  };
  add("us", s.scan);
  add("processor us", s.scan_processor);
  table.add({"bad lines of text", std::to_string(s.bad_lines)});
  return table.text();
}

/// What --scan has made, with --json.
struct DrawnScan {
  std::string file;
};
void describe(config::Fields& f, DrawnScan& drawn) { f.field("file", drawn.file); }

Status draw_one(const LinesOptions& o, const drivers::ReplayParams& geometry, const lines::ExtractorParams& params) {
  std::optional<LaserScan> chosen;
  std::uint64_t number = 0;
  const auto walked = walk(o.log, geometry, [&](const LaserScan& scan) {
    if (number++ == *o.scan) {
      chosen = scan;
    }
    return !chosen.has_value();
  });
  if (!walked) {
    return tl::unexpected<Error>(walked.error());
  }
  if (!chosen) {
    return fail(Errc::kNotFound, o.log.string() + " has " + std::to_string(number) + " scans; the first is number 0");
  }
  const std::string title = o.log.filename().string() + ", scan " + std::to_string(*o.scan) + ", " +
                            std::string(lines::to_string(params.kind));
  const Result<Image> picture = draw_scan(*chosen, lines::make_extractor(params)->extract(*chosen), title);
  return picture ? image::write_png(o.out, *picture) : Status(tl::unexpected<Error>(picture.error()));
}

}  // namespace

Result<LineStatistics> measure_lines(const std::filesystem::path& log, const drivers::ReplayParams& geometry,
                                     const lines::ExtractorParams& params) {
  const std::unique_ptr<lines::Extractor> extractor = lines::make_extractor(params);
  lines::ScanLines found;
  LineStatistics s;
  s.extractor = lines::to_string(params.kind);
  Stopwatch watch;
  std::vector<double> sigmas_m;
  double returns = 0.0;
  double on_lines = 0.0;
  const auto walked = walk(log, geometry, [&](const LaserScan& scan) {
    watch.start();
    extractor->extract(scan, found);
    watch.stop();
    watch.lap();
    s.beams = s.scans++ == 0 ? scan.ranges_m.size() : s.beams;
    s.lines += found.lines.size();
    s.most_lines = std::max<std::uint64_t>(s.most_lines, found.lines.size());
    sigmas_m.push_back(found.range_sigma_m);
    count_points(scan, found, returns, on_lines);
    return true;
  });
  if (!walked) {
    return tl::unexpected<Error>(walked.error());
  }
  if (s.scans == 0) {
    return fail(Errc::kParse, log.string() + " has no scan: " + drivers::describe(*walked));
  }
  std::sort(sigmas_m.begin(), sigmas_m.end());
  s.lines_per_scan = static_cast<double>(s.lines) / static_cast<double>(s.scans);
  s.points_on_lines = returns > 0.0 ? on_lines / returns : 0.0;
  s.range_sigma_m = sigmas_m[sigmas_m.size() / 2];
  s.scan = watch.wall();
  s.scan_processor = watch.processor();
  s.bad_lines = walked->bad;
  return s;
}

Status run_lines(const LinesOptions& o, std::ostream& out) {
  std::vector<std::string> overrides = o.overrides;
  if (!o.extractor.empty()) {
    overrides.push_back("lines.extractor=" + o.extractor);
  }
  const Result<RobotOfLog> robot = robot_of_log(o.robot, o.config, o.log, overrides);
  if (!robot) {
    return tl::unexpected<Error>(robot.error());
  }
  if (o.scan) {
    const Status drawn = draw_one(o, robot->options.replay.params, robot->options.lines);
    if (drawn) {
      out << (o.json ? to_json(DrawnScan{o.out.string()}) : "wrote " + o.out.string() + "\n");
    }
    return drawn;
  }
  const Result<LineStatistics> statistics = measure_lines(o.log, robot->options.replay.params, robot->options.lines);
  if (!statistics) {
    return tl::unexpected<Error>(statistics.error());
  }
  out << (o.json ? to_json(*statistics) : text_of(*statistics));
  return {};
}

}  // namespace seeker::lab
