#include "client/cli/export_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "client/cli/export_check.hpp"
#include "client/cli/scene.hpp"
#include "common/files/files.hpp"
#include "common/image/export_mark.hpp"
#include "common/image/segment_export.hpp"

namespace seeker::cli {
namespace {

namespace fs = std::filesystem;

using Files = std::vector<fs::path>;

bool wants(const std::vector<std::string>& formats, const char* format) {
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

Status write_text(const fs::path& path, const std::string& text, Files& files) {
  Status ok = files::write_file(path, text);
  if (ok) {
    files.push_back(path);
  }
  return ok;
}

Status write_svg(const fs::path& path, const std::string& title, const std::vector<MapSegment>& segments,
                 const std::vector<api::StampedPose>& trajectory, Files& files) {
  image::SegmentScene scene{title, segments, {}};
  for (const api::StampedPose& pose : trajectory) {
    scene.trajectory.push_back(pose.map_T_base);
  }
  const Result<std::string> svg = image::segments_svg(scene);
  return svg ? write_text(path, *svg, files) : Status(tl::unexpected<Error>(svg.error()));
}

/// The formats that are made of segments and trajectory.
Status write_vectors(const Context& context, const std::string& name, const std::vector<std::string>& formats,
                     Files& files) {
  const auto trajectory = ask<std::vector<api::StampedPose>>(context, &api::RobotApi::get_trajectory);
  if (!trajectory) {
    return tl::unexpected<Error>(trajectory.error());
  }
  Status ok;
  if (wants(formats, "svg") || wants(formats, "geojson")) {
    const auto segments = ask<api::SegmentUpdate>(
        context, [&](api::Reply<api::SegmentUpdate> r) { context.robot->get_segments(0, std::move(r)); });
    if (!segments) {
      return tl::unexpected<Error>(segments.error());
    }
    if (wants(formats, "svg")) {
      ok = write_svg(name + ".svg", fs::path(name).filename().string(), segments->changed, *trajectory, files);
    }
    if (ok && wants(formats, "geojson")) {
      ok = write_text(name + ".geojson", image::segments_geojson(segments->changed), files);
    }
  }
  if (ok && wants(formats, "tum")) {
    const bool stamped = std::any_of(trajectory->begin(), trajectory->end(),
                                     [](const api::StampedPose& pose) { return pose.stamp > RobotTime(); });
    ok = stamped ? write_text(name + ".tum", trajectory_tum(*trajectory), files)
                 : fail(Errc::kNotReady,
                        "the robot sends no times of its trajectory: it has not driven, or its "
                        "software is older than this program");
  }
  return ok;
}

}  // namespace

Result<Files> export_map_files(const Context& context, const std::string& name,
                               const std::vector<std::string>& formats) {
  Files files;
  Status ok = check_map_export(name, formats);
  if (!ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (wants(formats, "pgm") || wants(formats, "png")) {
    const Result<Files> pictures = export_map(context, name, {wants(formats, "png"), wants(formats, "pgm")});
    if (!pictures) {
      return pictures;
    }
    files = *pictures;
  }
  if (wants(formats, "svg") || wants(formats, "geojson") || wants(formats, "tum")) {
    ok = write_vectors(context, name, formats, files);
  }
  return ok ? Result<Files>(files) : tl::unexpected<Error>(ok.error());
}

std::string trajectory_tum(const std::vector<api::StampedPose>& trajectory) {
  std::string text = image::comment_mark(image::kMapExport) +
                     "# timestamp tx ty tz qx qy qz qw; the robot's base in its frame map, metres, robot time in s\n";
  for (const api::StampedPose& pose : trajectory) {
    const double half_rad = pose.map_T_base.theta_rad / 2.0;
    std::array<char, 160> line{};
    std::snprintf(line.data(), line.size(), "%.6f %.6f %.6f 0 0 0 %.9f %.9f\n", to_seconds(pose.stamp),
                  pose.map_T_base.x_m, pose.map_T_base.y_m, std::sin(half_rad), std::cos(half_rad));
    text += line.data();
  }
  return text;
}

}  // namespace seeker::cli
