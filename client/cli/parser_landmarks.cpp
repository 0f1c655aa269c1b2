// Databases of landmarks.

#include <CLI/CLI.hpp>

#include "client/cli/parser_parts.hpp"

namespace seeker::cli {
namespace {

void add_landmark_files(Parse& parse, CLI::App& landmarks) {
  auto [download, o] =
      add_verb<LandmarksDownloadVerb>(parse, landmarks, "download", "Copy a database of the robot to a file here",
                                      "seeker landmarks download lab lab.seekerlm");
  download->add_option("name", o->name, "Name of the database")->required();
  download->add_option("file", o->file, "File to write")->required();
  auto [upload, u] =
      add_verb<LandmarksUploadVerb>(parse, landmarks, "upload", "Give the robot a database from a file here",
                                    "seeker landmarks upload lab.seekerlm --name lab-copy");
  upload->add_option("file", u->file, "File of a database")->required();
  upload->add_option("--name", u->name, "Name to keep it under (default: that of the file)");
  upload->add_flag("--replace", u->replace, "Replace an existing database of that name");
}

}  // namespace

void add_landmarks(Parse& parse) {
  CLI::App* landmarks =
      add_group(parse.app, "landmarks", "Databases of landmarks: look into, check, copy, export, prune",
                "seeker landmarks info\n  seeker landmarks export lab out/lab.csv");
  auto [info, i] = add_verb<LandmarksInspectVerb>(parse, *landmarks, "info", "What is in a database, or in all of them",
                                                  "seeker landmarks info lab");
  info->add_option("name", i->name, "Name of the database (default: list all)");
  auto [verify, v] = add_verb<LandmarksInspectVerb>(parse, *landmarks, "verify", "Read and check a whole database",
                                                    "seeker landmarks verify lab");
  v->verify = true;
  verify->add_option("name", v->name, "Name of the database")->required();
  auto [out, e] = add_verb<LandmarksExportVerb>(
      parse, *landmarks, "export", "Write the landmarks as CSV, and a picture of them from above beside it",
      "seeker landmarks export lab out/lab.csv");
  out->add_option("name", e->name, "Name of the database")->required();
  out->add_option("file", e->file, "File to write (.csv; the picture is .png)")->required();
  auto [prune, p] =
      add_verb<LandmarksPruneVerb>(parse, *landmarks, "prune", "Delete landmarks that few pictures have shown",
                                   "seeker landmarks prune lab --min-views 3");
  prune->add_option("name", p->name, "Name of the database")->required();
  prune->add_option("--min-views", p->min_views, "Keep those seen in so many pictures or more")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  auto [revert, r] = add_verb<LandmarksRevertVerb>(
      parse, *landmarks, "revert", "Take back the last update or pruning of a database", "seeker landmarks revert lab");
  revert->add_option("name", r->name, "Name of the database")->required();
  auto [remove, d] = add_verb<LandmarksDeleteVerb>(parse, *landmarks, "delete", "Delete a database of the robot",
                                                   "seeker landmarks delete lab --yes");
  remove->add_option("name", d->name, "Name of the database")->required();
  remove->add_flag("--yes", d->yes, "Really: it does not come back");
  add_landmark_files(parse, *landmarks);
}

}  // namespace seeker::cli
