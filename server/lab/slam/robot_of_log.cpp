#include "server/lab/slam/robot_of_log.hpp"

#include <utility>

#include "common/files/config_folder.hpp"
#include "server/lab/slam/log_geometry.hpp"

namespace seeker::lab {
namespace {

Result<std::filesystem::path> find_robot_file(const std::filesystem::path& robot, const std::filesystem::path& config,
                                              const std::filesystem::path& log) {
  if (robot.empty()) {
    const Result<std::string> name = robot_file_for(log);
    if (!name) {
      return tl::unexpected<Error>(name.error());
    }
    return config / "robots" / *name;
  }
  return files::named_file(robot.string(), config / "robots");
}

}  // namespace

Result<RobotOfLog> robot_of_log(const std::filesystem::path& robot, const std::filesystem::path& config,
                                const std::filesystem::path& log, const std::vector<std::string>& overrides) {
  Result<std::filesystem::path> file = find_robot_file(robot, config, log);
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  Result<app::RobotOptions> options = app::load_robot_options(*file, overrides);
  if (!options) {
    return tl::unexpected<Error>(options.error());
  }
  return RobotOfLog{std::move(*file), std::move(*options)};
}

}  // namespace seeker::lab
