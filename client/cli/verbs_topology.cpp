// What the robot reports of its exploration by topology.

#include <algorithm>

#include <nlohmann/json.hpp>

#include "client/cli/scene.hpp"
#include "client/cli/update_queue.hpp"
#include "client/cli/verbs.hpp"
#include "client/values/values.hpp"
#include "client/values/values_json.hpp"

namespace seeker::cli {
namespace {

Status draw(const Context& context, const RobotTopology& robot, const std::string& file) {
  Result<image::MapScene> scene = fetch_scene(context, SceneOf::kMission);
  if (!scene) {
    return tl::unexpected<Error>(scene.error());
  }
  const std::vector<TopologyNode>& nodes = robot.topology.nodes;
  const auto current = std::find_if(nodes.begin(), nodes.end(),
                                    [&](const TopologyNode& node) { return node.id == robot.topology.current; });
  if (current != nodes.end()) {
    scene->space_tree = *current;
  }
  scene->robot.reset();  // drawn with its topology
  scene->topologies = {robot};
  return save_scene(file, *scene);
}

}  // namespace

VerbResult show_topology(const Context& context, const TopologyVerb& verb) {
  const Result<RobotTopology> robot = first_of<RobotTopology>(
      context, api::Topic::kTopology,
      "the robot sends no topology: it does not know where it is, or its software is older than this program");
  if (!robot) {
    return tl::unexpected<Error>(robot.error());
  }
  if (context.json) {
    *context.out << json_line(Json(*robot)) << '\n';
  } else {
    *context.out << text_of(*robot) << '\n';
    for (const TopologyNode& node : robot->topology.nodes) {
      *context.out << "  " << node.id << " at " << text_of(node.map_T_base.translation()) << " m, "
                   << count_of(node.goals.size(), "goal") << (node.id == robot->topology.current ? ", here" : "")
                   << '\n';
    }
  }
  if (robot->topology.nodes.empty()) {
    say(context, "no exploration by topology yet; 'seeker explore --strategy topological' begins one");
  }
  if (!verb.picture.empty()) {
    if (const Status ok = draw(context, *robot, verb.picture); !ok) {
      return tl::unexpected<Error>(ok.error());
    }
    say(context, "wrote " + verb.picture);
  }
  return ExitCode::kOk;
}

}  // namespace seeker::cli
