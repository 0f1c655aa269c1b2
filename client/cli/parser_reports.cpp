// What the robot is asked about itself and what it has seen.

#include <CLI/CLI.hpp>

#include "client/cli/parser_parts.hpp"
#include "client/values/names.hpp"
#include "common/api/audit.hpp"
#include "common/config/number_text.hpp"

namespace seeker::cli {

void add_reports(Parse& parse) {
  add_verb<StatusVerb>(parse, parse.app, "status", "Where the robot is, what it does, what is wrong", "seeker status");
  add_verb<DoctorVerb>(parse, parse.app, "doctor",
                       "What is wrong between here and a robot that works, and what to do; 1 when a check failed",
                       "seeker doctor --robot 10.0.0.5");
  auto [audit, a] = add_verb<AuditVerb>(parse, parse.app, "audit", "Who commanded what, also what was refused",
                                        "seeker audit --last 100 --client anna");
  audit->add_option("--last", a->last, "How many of the newest records")
      ->check(CLI::Range(1U, api::kMaxAuditRecords))
      ->capture_default_str();
  audit->add_option("--client", a->client, "Of this client alone; a name stands for all of its programs, too");
  auto [watch, w] = add_verb<WatchVerb>(parse, parse.app, "watch", "Follow the robot live until Ctrl-C or --timeout",
                                        "seeker watch --topics status,event --json");
  watch->add_option("--topics", w->topics, "Of " + listed(all_topics()))
      ->delimiter(',')
      ->check(CLI::IsMember(names_of(all_topics())));
  watch->add_option("--rate", w->rate_hz, "Highest rate of each topic, Hz")
      ->check(config::number_above_zero, "above 0")
      ->capture_default_str();
  add_maps(parse);
  auto [grid, g] = add_verb<GridVerb>(parse, parse.app, "grid", "What was searched, what was not, and the gaps",
                                      "seeker grid --evidence out/evidence.png");
  grid->add_option("--evidence", g->evidence, "Write the picture of what was seen and the gaps (.png or .svg)");
  auto [topology, t] = add_verb<TopologyVerb>(
      parse, parse.app, "topology", "Nodes, edges and goals of an exploration by topology, and its space tree",
      "seeker topology --picture out/topology.png");
  topology->add_option("--picture", t->picture, "Draw them on the map (.png or .svg)");
  add_verb<DetectionsVerb>(parse, parse.app, "detections", "What was found and where", "seeker detections --json");
  auto [lines, l] = add_verb<LinesVerb>(parse, parse.app, "lines", "The straight lines in the newest laser scan",
                                        "seeker lines --json\n  seeker lines --out out/lines.svg");
  lines->add_option("--out", l->out, "Write the picture of the scan with its lines (.png or .svg)");
  CLI::App* camera = add_group(parse.app, "camera", "Cameras", "seeker camera grab --out view.png");
  auto [grab, c] = add_verb<CameraGrabVerb>(parse, *camera, "grab", "Write one picture as PNG",
                                            "seeker camera grab --camera omni --out view.png");
  grab->add_option("--camera", c->camera, "Name of the camera (default: the one that targets are looked for with)");
  grab->add_option("--out", c->out, "File to write (default CAMERA.png)");
  add_components(parse);
}

}  // namespace seeker::cli
