// Maps that the robot keeps.

#include <CLI/CLI.hpp>

#include "client/cli/parser_parts.hpp"

namespace seeker::cli {
namespace {

void add_map_files(Parse& parse, CLI::App& map) {
  auto [info, i] = add_verb<MapInspectVerb>(parse, map, "info", "What is in a map", "seeker map info office");
  info->add_option("name", i->name, "Name of the map")->required();
  auto [verify, v] = add_verb<MapInspectVerb>(parse, map, "verify", "Read and check a whole map",
                                              "seeker map verify office\n  seeker map verify ./office.seekermap");
  v->verify = true;
  verify->add_option("name", v->name, "Name of a map of the robot, or a file here (with its .seekermap)")->required();
  auto [remove, d] =
      add_verb<MapDeleteVerb>(parse, map, "delete", "Delete a map of the robot", "seeker map delete office --yes");
  remove->add_option("name", d->name, "Name of the map")->required();
  remove->add_flag("--yes", d->yes, "Really: it does not come back");
  auto [download, o] = add_verb<MapDownloadVerb>(parse, map, "download", "Copy a map of the robot to a file here",
                                                 "seeker map download office office.seekermap");
  download->add_option("name", o->name, "Name of the map")->required();
  download->add_option("file", o->file, "File to write")->required();
  auto [upload, u] = add_verb<MapUploadVerb>(parse, map, "upload", "Give the robot a map from a file here",
                                             "seeker map upload office.seekermap --name office-copy");
  upload->add_option("file", u->file, "File of a map")->required();
  upload->add_option("--name", u->name, "Name to keep it under (default: that of the file)");
  upload->add_flag("--replace", u->replace, "Replace an existing map of that name");
}

}  // namespace

void add_maps(Parse& parse) {
  CLI::App* map = add_group(parse.app, "map", "Maps: keep, load, look into, copy, export",
                            "seeker map save office\n  seeker map export out/office");
  auto [map_export, m] = add_verb<MapExportVerb>(
      parse, *map, "export", "Write NAME.pgm and NAME.yaml (ROS map_server) and the picture NAME.png, or other formats",
      "seeker map export out/office\n  seeker map export out/office --format svg,geojson,tum");
  map_export->add_option("name", m->name, "Path without extension")->required();
  map_export->add_option("--format", m->formats, "Of pgm (with its yaml), png, svg, geojson, tum")
      ->delimiter(',')
      ->check(CLI::IsMember({"pgm", "png", "svg", "geojson", "tum"}));
  auto [save, s] = add_verb<MapSaveVerb>(parse, *map, "save", "Keep the present map of segments under a name",
                                         "seeker map save office");
  save->add_option("name", s->name, "[a-z0-9_-]{1,64}")->required();
  save->add_flag("--replace", s->replace, "Replace an existing map of that name");
  auto [load, l] = add_verb<MapLoadVerb>(parse, *map, "load", "Replace the present map by a kept one",
                                         "seeker map load office --localise && seeker relocalise --wait");
  load->add_option("name", l->name, "Name of the map")->required();
  load->add_flag("--localise", l->localise, "Only find the place in it: neither the map nor its file changes");
  add_verb<MapListVerb>(parse, *map, "list", "Maps that the robot keeps", "seeker map list --json");
  add_map_files(parse, *map);
  auto [relocalise, r] =
      add_verb<RelocaliseVerb>(parse, parse.app, "relocalise", "Have the robot look for its place in the map",
                               "seeker relocalise --wait\n  seeker relocalise --at 3,4.5,90 --wait\n"
                               "With --wait: 0 when it has found its place, 1 when it is lost.");
  relocalise->add_option("--at", r->at, "Look near this pose, x,y,degrees (default: everywhere)");
  relocalise->add_flag("--wait", r->wait, "Wait until the robot has found its place or given up");
}

}  // namespace seeker::cli
