// Databases of landmarks: figures, checks, export, pruning.

#include <cstdio>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "client/cli/export_check.hpp"
#include "client/cli/show_done.hpp"
#include "client/cli/transfer.hpp"
#include "client/cli/verbs.hpp"
#include "client/values/values.hpp"
#include "client/values/values_json.hpp"
#include "common/files/files.hpp"
#include "common/image/export_mark.hpp"
#include "common/image/plot.hpp"
#include "common/image/png.hpp"

namespace seeker::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kPictureSide_px = 900;

/// One line: the database in figures.
std::string line_of(const api::LandmarkSummary& database) {
  if (!database.problem.empty()) {
    return database.name + "  UNUSABLE: " + database.problem;
  }
  return database.name + "  " + std::to_string(database.landmarks) + " landmarks, revision " +
         std::to_string(database.revision) + ", " + size_of(database.file_bytes) + ", saved " +
         date_of(database.saved_unix_s) + " by " +
         (database.robot_id.empty() ? "an unnamed robot" : database.robot_id) +
         (database.map_name.empty() ? "" : ", in the frame of map " + database.map_name);
}

VerbResult show(const Context& context, const Result<api::LandmarkSummary>& database, const std::string& done) {
  if (!database) {
    return tl::unexpected<Error>(database.error());
  }
  *context.out << (context.json ? json_line(Json(*database)) : line_of(*database)) << '\n';
  if (!done.empty()) {
    say(context, done);
  }
  return ExitCode::kOk;
}

VerbResult list(const Context& context) {
  const auto databases = ask<std::vector<api::LandmarkSummary>>(context, &api::RobotApi::list_landmarks);
  if (!databases) {
    return tl::unexpected<Error>(databases.error());
  }
  if (context.json) {
    *context.out << json_line(Json{{"databases", *databases}}) << '\n';
    return ExitCode::kOk;
  }
  for (const api::LandmarkSummary& database : *databases) {
    *context.out << line_of(database) << '\n';
  }
  if (databases->empty()) {
    say(context, "there is no database of landmarks yet; 'seeker survey NAME' makes one");
  }
  return ExitCode::kOk;
}

std::string csv_of(const std::vector<api::LandmarkPoint>& landmarks) {
  std::string text = "id,x_m,y_m,z_m,sigma_m,views\n";
  for (const api::LandmarkPoint& landmark : landmarks) {
    char line[160];
    std::snprintf(line, sizeof line, "%llu,%.4f,%.4f,%.4f,%.4f,%u\n", static_cast<unsigned long long>(landmark.id),
                  landmark.p.x(), landmark.p.y(), landmark.z_m, landmark.sigma_m, landmark.views);
    text += line;
  }
  return text;
}

/// From above: those of many views apart from the others.
Image picture_of(const std::string& name, const std::vector<api::LandmarkPoint>& landmarks) {
  constexpr std::uint32_t kSalient = 3;  // spec S2.7
  image::Chart chart;
  chart.title = name + ": " + std::to_string(landmarks.size()) + " landmarks";
  chart.x_label = "x, m";
  chart.y_label = "y, m";
  chart.equal_scale = true;
  image::Series few{.name = "seen in fewer than 3 pictures", .x = {}, .y = {}, .style = image::SeriesStyle::kPoints};
  image::Series many{.name = "in 3 or more", .x = {}, .y = {}, .style = image::SeriesStyle::kPoints};
  for (const api::LandmarkPoint& landmark : landmarks) {
    image::Series& series = landmark.views < kSalient ? few : many;
    series.x.push_back(landmark.p.x());
    series.y.push_back(landmark.p.y());
  }
  chart.series = {std::move(few), std::move(many)};
  return image::draw_chart(chart, kPictureSide_px, kPictureSide_px);
}

}  // namespace

VerbResult inspect_landmarks(const Context& context, const LandmarksInspectVerb& verb) {
  if (verb.name.empty()) {
    return list(context);
  }
  const auto database = ask<api::LandmarkSummary>(context, [&](api::Reply<api::LandmarkSummary> reply) {
    context.robot->inspect_landmarks(verb.name, verb.verify, std::move(reply));
  });
  return show(context, database, verb.verify ? verb.name + " is sound" : "");
}

VerbResult export_landmarks(const Context& context, const LandmarksExportVerb& verb) {
  using Landmarks = std::vector<api::LandmarkPoint>;
  const auto landmarks = ask<Landmarks>(
      context, [&](api::Reply<Landmarks> reply) { context.robot->get_landmarks(verb.name, std::move(reply)); });
  if (!landmarks) {
    return tl::unexpected<Error>(landmarks.error());
  }
  const fs::path picture = fs::path(verb.file).replace_extension(".png");
  Status ok = check_replaceable({picture}, image::kLandmarksExport);
  if (ok) {
    ok = files::write_file(verb.file, csv_of(*landmarks));
  }
  if (ok) {
    ok = image::write_png(picture, picture_of(verb.name, *landmarks), image::kLandmarksExport);
  }
  return show_done(
      context, ok,
      "wrote " + verb.file + " and " + picture.string() + ", " + std::to_string(landmarks->size()) + " landmarks");
}

VerbResult prune_landmarks(const Context& context, const LandmarksPruneVerb& verb) {
  const auto database = ask<api::LandmarkSummary>(context, [&](api::Reply<api::LandmarkSummary> reply) {
    context.robot->prune_landmarks(verb.name, verb.min_views, std::move(reply));
  });
  return show(context, database, "");
}

VerbResult revert_landmarks(const Context& context, const LandmarksRevertVerb& verb) {
  const auto database = ask<api::LandmarkSummary>(context, [&](api::Reply<api::LandmarkSummary> reply) {
    context.robot->revert_landmarks(verb.name, std::move(reply));
  });
  return show(context, database, "");
}

VerbResult delete_landmarks(const Context& context, const LandmarksDeleteVerb& verb) {
  if (!verb.yes) {
    return fail(Errc::kInvalidArgument,
                "a deleted database does not come back; say --yes to delete '" + verb.name + "'");
  }
  return show_done(
      context,
      ask<void>(context, [&](api::Reply<void> reply) { context.robot->delete_landmarks(verb.name, std::move(reply)); }),
      "database '" + verb.name + "' is deleted");
}

VerbResult download_landmarks(const Context& context, const LandmarksDownloadVerb& verb) {
  return show_done(context, fetch_file(context, api::FileKind::kLandmarks, verb.name, verb.file), "wrote " + verb.file);
}

VerbResult upload_landmarks(const Context& context, const LandmarksUploadVerb& verb) {
  const std::string name = verb.name.empty() ? fs::path(verb.file).stem().string() : verb.name;
  if (const Status ok = validate_map_name(name); !ok) {
    return fail(Errc::kInvalidArgument,
                "'" + name + "' cannot name a database (" + ok.error().message + "); give another one with --name");
  }
  bool too_old = false;
  const Result<api::UploadedFile> taken =
      send_file(context, verb.file, {api::FileKind::kLandmarks, {}, name, verb.replace, false}, too_old);
  if (!taken) {
    return tl::unexpected<Error>(taken.error());
  }
  return taken->landmarks ? show(context, *taken->landmarks, "")
                          : fail(Errc::kInternal, "the robot's answer has no summary of the database");
}

}  // namespace seeker::cli
