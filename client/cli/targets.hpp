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

/// What the command line or a mission script says about all targets, over what their files say.
struct TargetDefaults {
  std::string recogniser;  ///< empty: as the file says
  std::optional<double> width_m;
  std::optional<double> height_m;
  std::optional<double> depth_m;
};

/// Where a target's NAME is looked for: the given folders, ./config/targets, beside the program, /usr/share/seeker.
[[nodiscard]] std::vector<std::filesystem::path> target_folders(const std::vector<std::string>& given);

/// Reads NAME, FILE.yaml (keys name, picture, width_m, height_m, depth_m, recogniser, solid) or FILE.png. Errors name
/// the file and, for a YAML, line and key; kNotFound names the folders that were searched and what is there.
[[nodiscard]] Result<api::TargetSpec> load_target(const std::string& name_or_file, const TargetDefaults& defaults,
                                                  const std::vector<std::filesystem::path>& folders);

/// The same for all of `names`, and the solids of these names (see to_string(SolidKind)) after them.
[[nodiscard]] Result<std::vector<api::TargetSpec>> load_targets(const std::vector<std::string>& names,
                                                                const std::vector<std::string>& solids,
                                                                const TargetDefaults& defaults,
                                                                const std::vector<std::filesystem::path>& folders);

/// Corners "x,y x,y ..." or @FILE with a YAML list [[x, y], ...].
[[nodiscard]] Result<Polygon> parse_polygon(const std::string& text);
/// "x,y".
[[nodiscard]] Result<Point2> parse_point(const std::string& text);
/// "300s", "2.5min", "1h", "200ms" or a plain number of seconds; above 0 and at most 30 days.
[[nodiscard]] Result<Duration> parse_duration(const std::string& text);

[[nodiscard]] api::LinkPolicy parse_link_policy(const std::string& name);
[[nodiscard]] api::OnFound parse_on_found(const std::string& name);
[[nodiscard]] api::SearchMode parse_search_mode(const std::string& name);
[[nodiscard]] api::ExploreStrategy parse_explore_strategy(const std::string& name);

}  // namespace seeker::cli
