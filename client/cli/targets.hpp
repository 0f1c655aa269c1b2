/// \file
/// Targets as users name them: a name, a YAML file or a picture.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/api/mission.hpp"
#include "common/core/polygon.hpp"

namespace seeker::cli {

/// Properties of all targets from the command line or a mission script; they override those in the files of targets.
struct TargetDefaults {
  std::string recogniser;  ///< name; empty: as in the file
  std::optional<double> width_m;
  std::optional<double> height_m;
  std::optional<double> depth_m;
};

/// The folders in which a target NAME is searched: `given`, then targets/ of files::config_folder().
[[nodiscard]] std::vector<std::filesystem::path> target_folders(const std::vector<std::string>& given);

/// Reads NAME, FILE.yaml (keys name, picture, width_m, height_m, depth_m, recogniser, solid) or FILE.png. Errors name
/// the file and, for a YAML, line and key; kNotFound names the searched folders and the targets in them.
[[nodiscard]] Result<api::TargetSpec> load_target(const std::string& name_or_file, const TargetDefaults& defaults,
                                                  const std::vector<std::filesystem::path>& folders);

/// Loads all targets of `names`, followed by the solids of the names `solids` (see to_string(SolidKind)).
[[nodiscard]] Result<std::vector<api::TargetSpec>> load_targets(const std::vector<std::string>& names,
                                                                const std::vector<std::string>& solids,
                                                                const TargetDefaults& defaults,
                                                                const std::vector<std::filesystem::path>& folders);

/// Reads the corners "x,y x,y ..." in m, frame `map`, or @FILE with a YAML list [[x, y], ...].
[[nodiscard]] Result<Polygon> parse_polygon(const std::string& text);
/// Reads two numbers "x,y".
[[nodiscard]] Result<Point2> parse_point(const std::string& text);
/// Reads "300s", "2.5min", "1h", "200ms" or a plain number of seconds; above 0 and at most 30 days.
[[nodiscard]] Result<Duration> parse_duration(const std::string& text);

/// A link policy: its short form, or a list.
struct LinkChoice {
  api::LinkPolicy policy = api::LinkPolicy::kStop;
  api::LinkSteps steps;  ///< empty: the short form
};
/// "return", or "2:event,5:pause,30:return".
[[nodiscard]] Result<LinkChoice> parse_link_policy(const std::string& text);
[[nodiscard]] api::OnFound parse_on_found(const std::string& name);
[[nodiscard]] api::SearchMode parse_search_mode(const std::string& name);
[[nodiscard]] api::ExploreStrategy parse_explore_strategy(const std::string& name);

}  // namespace seeker::cli
