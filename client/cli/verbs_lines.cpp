#include <cstdio>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "client/cli/scene.hpp"
#include "client/cli/update_queue.hpp"
#include "client/cli/verbs.hpp"
#include "client/values/values.hpp"
#include "client/values/values_json.hpp"
#include "common/core/angle.hpp"
#include "common/image/export_mark.hpp"
#include "common/image/scan_picture.hpp"

namespace seeker::cli {
namespace {

image::ScanScene scene_of(const api::LineReport& report) {
  LaserScan in_laser = report.scan;
  in_laser.base_T_laser = {};
  image::ScanScene scene{.title = count_of(report.scan.ranges_m.size(), "beam") + " at " +
                                  fixed("%.2f s", to_seconds(report.scan.stamp)) + ", " + report.extractor,
                         .points = points_in_base(in_laser),
                         .lines = {}};
  for (const api::ScanLine& line : report.lines) {
    scene.lines.emplace_back(line.start, line.end);
  }
  return scene;
}

Status save_lines(const std::filesystem::path& path, const api::LineReport& report) {
  const image::ScanScene scene = scene_of(report);
  return save_drawing(
      path, image::kLinesPicture, [&] { return image::draw_scan(scene); }, [&] { return image::scan_svg(scene); });
}

std::string row_of(std::size_t number, const api::ScanLine& line) {
  const auto text = [](const char* format, const std::optional<double>& value) {
    return value ? fixed(format, *value) : std::string("       -");
  };
  return fixed("%3.0f", static_cast<double>(number)) + fixed(" %8.2f", rad_to_deg(line.normal_rad)) +
         fixed(" %8.2f", rad_to_deg(line.start_rad)) + fixed(" %8.2f", rad_to_deg(line.end_rad)) +
         fixed(" %8.3f", line.distance_m) + fixed(" %8.3f ", line.length_m) + text("%8.3f", line.slope) + " " +
         text("%8.3f", line.intercept_m) + fixed(" %6.0f", static_cast<double>(line.points)) +
         fixed(" %8.1f", 1e3 * line.fit_error_m);
}

}  // namespace

VerbResult show_lines(const Context& context, const LinesVerb& verb) {
  const Result<api::LineReport> report = first_of<api::LineReport>(
      context, api::Topic::kLines,
      "no laser scan came in time; 'seeker components' says whether the robot has a laser scanner that works, and "
      "--timeout waits longer");
  if (!report) {
    return tl::unexpected<Error>(report.error());
  }
  if (!verb.out.empty()) {
    if (const Status ok = save_lines(verb.out, *report); !ok) {
      return tl::unexpected<Error>(ok.error());
    }
    say(context, "wrote " + verb.out);
  }
  if (context.json) {
    *context.out << json_line(Json(*report)) << '\n';
    return ExitCode::kOk;
  }
  *context.out << "  n    theta    start      end        d   length    kappa        b points error,mm\n"
               << "         deg      deg      deg        m        m                 m\n";
  for (std::size_t k = 0; k < report->lines.size(); ++k) {
    *context.out << row_of(k + 1, report->lines[k]) << '\n';
  }
  say(context, count_of(report->lines.size(), "line") + " in " + count_of(report->scan.ranges_m.size(), "beam") +
                   " by " + report->extractor + fixed(", range noise %.1f mm", 1e3 * report->range_sigma_m));
  return ExitCode::kOk;
}

}  // namespace seeker::cli
