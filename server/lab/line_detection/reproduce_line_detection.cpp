#include "server/lab/line_detection/reproduce_line_detection.hpp"

#include <cstdlib>
#include <filesystem>

#include "common/core/angle.hpp"
#include "common/files/files.hpp"
#include "common/image/png.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/line_detection/line_history.hpp"
#include "server/lab/line_detection/line_scene.hpp"
#include "server/lab/line_detection/line_sensitivity.hpp"

namespace seeker::lab {
namespace {

constexpr double kMillimetres = 1000.0;

/// Table 1: what is printed beside what was found.
std::string table1_csv(const LaserScan& scan, const lines::ScanLines& found) {
  Table table({"line", "P", "P_found", "kappa", "kappa_found", "b_mm", "b_found_mm", "mean_error_mm",
               "mean_error_found_mm", "r_mm", "r_found_mm", "alpha_deg", "alpha_found_deg", "start_deg", "end_deg",
               "length_mm"});
  for (const TableLine& row : kTable1) {
    const std::optional<std::size_t> index = find_row(found, row);
    if (!index) {
      table.add({row.name, std::to_string(row.points), "0"});
      continue;
    }
    const lines::Line& line = found.lines[*index];
    table.add({row.name, std::to_string(row.points), std::to_string(line.points), fixed(row.slope, 3),
               line.slope ? fixed(*line.slope, 3) : "none", fixed(row.intercept_mm, 1),
               line.intercept_m ? fixed(kMillimetres * *line.intercept_m, 1) : "none",
               fixed(row.printed_mean_error_mm, 2), fixed(kMillimetres * mean_error_m(scan, found, *index), 2),
               fixed(kMillimetres * true_r_m(row), 1), fixed(kMillimetres * line.r_m, 1),
               fixed(rad_to_deg(true_alpha_rad(row)), 2), fixed(rad_to_deg(line.alpha_rad), 2),
               fixed(rad_to_deg(line.start_rad), 0), fixed(rad_to_deg(line.end_rad), 0),
               fixed(kMillimetres * line.length_m, 1)});
  }
  return table.csv();
}

/// Scenes drawn from the seeds, and the recorded RPLIDAR where it is there.
Status compare_scenes(const ReproduceParams& params, Report& report) {
  std::vector<LaserScan> scenes;
  for (const std::uint64_t seed : params.seeds) {
    scenes.push_back(scene_scan(seed));
  }
  std::string csv = check_sensitivity("scenes", scenes, report);
  const char* data = std::getenv("SEEKER_DATA");
  const std::filesystem::path log =
      std::filesystem::path(data == nullptr ? "" : data) / "lidar/rplidar_a1/scans.csv.gz";
  if (data != nullptr && std::filesystem::exists(log)) {
    const std::size_t step = params.smallest ? 60 : 4;
    const Result<std::vector<LaserScan>> scans = scans_of_log(log, params.config / "robots/replay-rplidar.yaml", step);
    if (!scans) {
      return tl::unexpected<Error>(scans.error());
    }
    csv += check_sensitivity("rplidar_a1", *scans, report);
  }
  return files::write_file(params.out / "sensitivity.csv", csv);
}

}  // namespace

lines::PaperParams printed_line_params() {
  lines::PaperParams params;
  params.fit_error_sigmas = 0.0;
  params.corner_sigmas = 0.0;
  params.noise.sigma_m = kTable1Sigma_m;
  return params;
}

Status reproduce_line_detection(const ReproduceParams& params, Report& report) {
  std::error_code error;
  std::filesystem::create_directories(params.out, error);
  if (params.seeds.empty()) {
    return fail(Errc::kInvalidArgument, "no seeds to run: name some with --seeds");
  }
  Rng rng(params.seeds.front());
  const LaserScan scan = table1_scan(rng);
  const lines::ScanLines found = lines::PaperExtractor(printed_line_params()).extract(scan);
  if (Status ok = image::write_png(params.out / "fig3-lines.png", table1_figure(scan, found)); !ok) {
    return ok;
  }
  if (Status ok = image::write_png(params.out / "fig4-fits.png", table1_fit_figure(scan, found)); !ok) {
    return ok;
  }
  if (Status ok = files::write_file(params.out / "table1.csv", table1_csv(scan, found)); !ok) {
    return ok;
  }
  check_rows(params.seeds, report);
  check_table1(params.seeds, report);
  if (Status ok = files::write_file(params.out / "thresholds.csv", check_thresholds(params.seeds, report)); !ok) {
    return ok;
  }
  const ThresholdHistory history = check_history(params.seeds, report);
  if (Status ok = files::write_file(params.out / "history.csv", history.csv); !ok) {
    return ok;
  }
  if (Status ok = image::write_png(params.out / "fig-thresholds.png", history.figure); !ok) {
    return ok;
  }
  return compare_scenes(params, report);
}

}  // namespace seeker::lab
