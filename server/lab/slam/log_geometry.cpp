#include "server/lab/slam/log_geometry.hpp"

#include "server/drivers/replay/line_file.hpp"
#include "server/drivers/replay/scan_csv.hpp"

namespace seeker::lab {

Result<std::string> robot_file_for(const std::filesystem::path& log) {
  constexpr std::size_t kUrgBeams = 726;
  Result<drivers::LineFile> file = drivers::LineFile::open(log);
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  std::string line;
  using Line = drivers::LineFile::Line;
  for (Line kind = file->next(line); kind != Line::kEnd; kind = file->next(line)) {
    const auto record = drivers::parse_log_line(line);
    const auto* scan = record && *record ? std::get_if<drivers::CarmenScan>(&**record) : nullptr;
    if (kind == Line::kTooLong || scan == nullptr) {
      continue;
    }
    if (drivers::is_scan_csv(line)) {
      return "replay-rplidar.yaml";
    }
    return scan->ranges_m.size() == kUrgBeams && !scan->angle_step_rad ? "replay-p3dx.yaml" : "replay.yaml";
  }
  return fail(Errc::kParse, log.string() + " holds no scan of a CARMEN log or of scans with commas");
}

}  // namespace seeker::lab
