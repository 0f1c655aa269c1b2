#include "client/cli/scene.hpp"

#include <algorithm>

#include "client/cli/export_check.hpp"
#include "client/values/values.hpp"
#include "common/files/files.hpp"
#include "common/image/export_mark.hpp"
#include "common/image/map_server.hpp"
#include "common/image/png.hpp"

namespace seeker::cli {
namespace {

namespace fs = std::filesystem;

/// 64 MiB of cells: a square of 410 m.
constexpr long kMaxTilesSpanned = 16384;

bool fits_one_grid(const std::vector<OccupancyTile>& tiles) {
  const auto [low_i, high_i] = std::minmax_element(tiles.begin(), tiles.end(),
                                                   [](const auto& a, const auto& b) { return a.index.i < b.index.i; });
  const auto [low_j, high_j] = std::minmax_element(tiles.begin(), tiles.end(),
                                                   [](const auto& a, const auto& b) { return a.index.j < b.index.j; });
  const long columns = static_cast<long>(high_i->index.i) - low_i->index.i + 1;
  const long rows = static_cast<long>(high_j->index.j) - low_j->index.j + 1;
  return columns <= kMaxTilesSpanned && rows <= kMaxTilesSpanned && columns * rows <= kMaxTilesSpanned;
}

/// Absent where the robot says that it has none; other failures are failures.
template <class T>
Result<std::optional<T>> optional_answer(Result<T> answer) {
  if (answer) {
    return std::optional<T>(std::move(*answer));
  }
  const Errc code = answer.error().code;
  if (code == Errc::kNotFound || code == Errc::kNotReady) {
    return std::optional<T>();
  }
  return tl::unexpected<Error>(answer.error());
}

void add_grid(image::MapScene& scene, const api::GridReport& grid) {
  scene.cell_size_m = grid.lists.cell_size_m;
  scene.searched = grid.lists.searched;
  scene.unsearched = grid.lists.unsearched;
  scene.unreachable = grid.lists.unreachable;
  if (!grid.evidence.probability.empty()) {
    scene.evidence = grid.evidence.probability;
    const api::CoverageSummary& summary = grid.evidence.summary;
    scene.facts.emplace_back("reachable floor", fixed("%.1f m\xC2\xB2", summary.reachable_area_m2));
    scene.facts.emplace_back("searched", fixed("%.1f m\xC2\xB2", summary.covered_area_m2));
    scene.facts.emplace_back("mean probability", fixed("%.2f", summary.mean_probability));
  }
  scene.gaps = marks_of(grid.evidence.gaps);
}

bool is_search(const api::MissionStatus& mission) { return mission.kind == api::task_name(api::SearchMission{}); }

bool is_exploration(const api::MissionStatus& mission) { return mission.kind == api::task_name(api::ExploreMission{}); }

/// Only a search or an exploration is what the picture is of; after a drive or a survey it is the map that is shown.
void add_status(image::MapScene& scene, const api::RobotStatus& status) {
  if (is_placed(status.pose.quality)) {
    scene.robot = status.pose.map_T_base;
  }
  if (!status.mission || !(is_search(*status.mission) || is_exploration(*status.mission))) {
    return;
  }
  const api::MissionStatus& mission = *status.mission;
  scene.title = is_search(mission) ? "Search" : "Exploration";
  // Ids that seeker makes begin with the kind, which the title shows already.
  const bool begins_with_kind =
      mission.id.starts_with(mission.kind + "-") && mission.id.size() > mission.kind.size() + 1;
  scene.facts.emplace_back("mission", begins_with_kind ? mission.id.substr(mission.kind.size() + 1) : mission.id);
  scene.facts.emplace_back(
      "outcome", mission.end ? std::string(to_string(mission.end->outcome)) : std::string(to_string(mission.state)));
  scene.facts.emplace_back("path", fixed("%.1f m", mission.path_length_m));
  scene.facts.emplace_back("robot time", fixed("%.0f s", to_seconds(mission.updated - mission.started)));
  if (!mission.end) {
    scene.planned_path = mission.planned_path;
  }
}

/// Those of mission `only`, where it is named. Robots of older versions do not say which mission has found it.
void add_detections(image::MapScene& scene, const std::vector<api::Detection>& detections, const api::MissionId& only) {
  for (const api::Detection& d : detections) {
    if (only.empty() || d.mission.empty() || d.mission == only) {
      scene.detections.push_back(mark_of(d));
    }
  }
}

/// Fills one part of the scene, when the robot has it.
template <class T, class Add>
Status add_part(const Context& context, void (api::RobotApi::*method)(api::Reply<T>), Add add) {
  const Result<std::optional<T>> part = optional_answer(ask<T>(context, method));
  if (!part) {
    return tl::unexpected<Error>(part.error());
  }
  if (*part) {
    add(**part);
  }
  return {};
}

}  // namespace

image::DetectionMark mark_of(const api::Detection& detection) {
  return {detection.target, detection.position, detection.position_covariance, detection.map_T_base.translation(),
          detection.bearing_map_rad};
}

Result<std::optional<Grid<std::uint8_t>>> join_tiles(const std::vector<OccupancyTile>& tiles) {
  if (tiles.empty()) {
    return std::optional<Grid<std::uint8_t>>();
  }
  if (!fits_one_grid(tiles)) {
    return fail(Errc::kTooLarge, "the map's tiles lie too far apart for one picture; something was sensed far away");
  }
  return assemble(tiles);
}

Result<std::optional<Grid<std::uint8_t>>> fetch_occupancy(const Context& context) {
  const Result<std::optional<api::TileUpdate>> tiles = optional_answer(
      ask<api::TileUpdate>(context, [&](api::Reply<api::TileUpdate> r) { context.robot->get_tiles(0, std::move(r)); }));
  if (!tiles) {
    return tl::unexpected<Error>(tiles.error());
  }
  return *tiles ? join_tiles((*tiles)->tiles) : std::optional<Grid<std::uint8_t>>();
}

Result<image::MapScene> fetch_scene(const Context& context, SceneOf of) {
  image::MapScene scene;
  scene.title = "Map";
  Result<std::optional<Grid<std::uint8_t>>> occupancy = fetch_occupancy(context);
  if (!occupancy) {
    return tl::unexpected<Error>(occupancy.error());
  }
  scene.occupancy = std::move(*occupancy);
  using api::RobotApi;
  std::optional<api::MissionStatus> mission;
  Status ok = add_part<api::RobotInfo>(context, &RobotApi::get_info,
                                       [&](const api::RobotInfo& info) { scene.robot_radius_m = info.robot_radius_m; });
  if (ok) {
    ok = add_part<api::RobotStatus>(context, &RobotApi::get_status, [&](const auto& status) {
      mission = status.mission;
      add_status(scene, status);
    });
  }
  // What the robot has kept of an earlier search is not what an exploration did.
  const bool explored = mission && is_exploration(*mission);
  if (explored && of == SceneOf::kEvidence) {
    scene.title = "Evidence of a search";
    scene.facts.clear();
  }
  const bool evidence = !explored || of == SceneOf::kEvidence;
  const bool own_only = mission && of == SceneOf::kMission && (explored || is_search(*mission));
  if (ok) {
    ok = add_part<std::vector<api::StampedPose>>(context, &RobotApi::get_trajectory, [&](const auto& trajectory) {
      for (const api::StampedPose& pose : trajectory) {
        scene.trajectory.push_back(pose.map_T_base);
      }
    });
  }
  if (ok && evidence) {
    ok = add_part<api::GridReport>(context, &RobotApi::get_grid, [&](const auto& g) { add_grid(scene, g); });
  }
  if (ok) {
    ok = add_part<std::vector<api::Detection>>(context, &RobotApi::get_detections, [&](const auto& d) {
      add_detections(scene, d, own_only ? mission->id : api::MissionId());
    });
  }
  if (!ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return scene;
}

Status save_picture(const fs::path& path, const Image& picture, std::string_view mark) {
  Status ok = make_folder_of(path);
  return ok ? image::write_png(path, picture, mark) : ok;
}

Status save_drawing(const fs::path& path, std::string_view mark, const std::function<Result<Image>()>& pixels,
                    const std::function<Result<std::string>()>& shapes) {
  if (path.extension() != ".svg") {
    const Result<Image> picture = pixels();
    return picture ? save_picture(path, *picture, mark) : Status(tl::unexpected<Error>(picture.error()));
  }
  const Result<std::string> drawing = shapes();
  const Status ok = drawing ? make_folder_of(path) : Status(tl::unexpected<Error>(drawing.error()));
  return ok ? files::write_file(path, image::with_xml_mark(*drawing, mark)) : ok;
}

Status save_scene(const fs::path& path, const image::MapScene& scene) {
  return save_drawing(
      path, image::kMapExport, [&] { return image::draw_map(scene); }, [&] { return image::map_svg(scene); });
}

Result<std::vector<fs::path>> export_map(const Context& context, const std::string& name, const MapPictures& pictures) {
  std::vector<std::string> formats;
  if (pictures.png) {
    formats.emplace_back("png");
  }
  if (pictures.map_server) {
    formats.emplace_back("pgm");
  }
  if (const Status free = check_map_export(name, formats); !free) {
    return tl::unexpected<Error>(free.error());
  }
  const Result<image::MapScene> scene = fetch_scene(context, SceneOf::kMission);
  if (!scene) {
    return tl::unexpected<Error>(scene.error());
  }
  return export_scene(*scene, name, formats);
}

Result<std::vector<fs::path>> export_scene(const image::MapScene& scene, const std::string& name,
                                           const std::vector<std::string>& formats) {
  std::vector<fs::path> files;
  for (const std::string& format : formats) {
    const bool is_picture = format != "pgm";
    if (!is_picture && !scene.occupancy) {
      continue;
    }
    const Status ok =
        is_picture ? save_scene(name + "." + format, scene) : image::write_map_server(name, *scene.occupancy);
    if (!ok) {
      return tl::unexpected<Error>(ok.error());
    }
    const std::vector<fs::path> written = map_export_files(name, {format});
    files.insert(files.end(), written.begin(), written.end());
  }
  return files;
}

}  // namespace seeker::cli
