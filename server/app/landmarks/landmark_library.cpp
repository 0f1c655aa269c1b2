#include "server/app/landmarks/landmark_library.hpp"

#include <algorithm>
#include <utility>

#include "server/app/runtime/disk_worker.hpp"

namespace seeker::app {
namespace {

store::Vector3Record record_of(const localize::Point3& p) { return {p.x(), p.y(), p.z()}; }
localize::Point3 point_of(const store::Vector3Record& r) { return {r[0], r[1], r[2]}; }

store::LandmarkRecord record_of(const localize::Landmark& landmark) {
  store::LandmarkRecord record;
  record.id = landmark.id;
  record.p_map = record_of(landmark.p_map);
  const Matrix3& m = landmark.information;
  record.information = {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
  record.to_eye = record_of(landmark.to_eye);
  record.concentration = landmark.concentration;
  record.scale_m = landmark.scale_m;
  record.seen = landmark.seen;
  record.expected = landmark.expected;
  record.misses = landmark.misses;
  record.log_odds = landmark.log_odds;
  record.last_seen = landmark.last_seen;
  for (const localize::LandmarkView& view : landmark.views) {
    record.sides.push_back({record_of(view.to_eye), view.seen, view.descriptor});
  }
  return record;
}

/// What does not fit is damaged: restore() refuses 0.
int int_of(std::int64_t value) { return std::in_range<int>(value) ? static_cast<int>(value) : -1; }

localize::Landmark landmark_of(const store::LandmarkRecord& record) {
  localize::Landmark landmark;
  landmark.id = record.id;
  landmark.p_map = point_of(record.p_map);
  const auto& i = record.information;
  landmark.information << i[0], i[1], i[2], i[1], i[3], i[4], i[2], i[4], i[5];
  landmark.to_eye = point_of(record.to_eye);
  landmark.concentration = record.concentration;
  landmark.scale_m = record.scale_m;
  landmark.seen = int_of(record.seen);
  landmark.expected = int_of(record.expected);
  landmark.misses = int_of(record.misses);
  landmark.log_odds = record.log_odds;
  landmark.last_seen = record.last_seen;
  for (const store::LandmarkSide& side : record.sides) {
    landmark.views.push_back({side.descriptor, point_of(side.to_eye), int_of(side.seen)});
  }
  return landmark;
}

store::LandmarkContent content_of(const localize::LandmarkDatabase& database) {
  store::LandmarkContent content;
  content.calibration = database.calibration();
  content.next_id = database.next_id();
  content.sightings = database.sightings();
  content.landmarks.reserve(database.size());
  for (const localize::Landmark& landmark : database.landmarks()) {
    content.landmarks.push_back(record_of(landmark));
  }
  std::sort(content.landmarks.begin(), content.landmarks.end(),
            [](const store::LandmarkRecord& a, const store::LandmarkRecord& b) { return a.id < b.id; });
  return content;
}

Result<localize::LandmarkDatabase> database_of(const store::LandmarkContent& content) {
  std::vector<localize::Landmark> landmarks;
  landmarks.reserve(content.landmarks.size());
  for (const store::LandmarkRecord& record : content.landmarks) {
    landmarks.push_back(landmark_of(record));
  }
  return localize::LandmarkDatabase::restore(content.calibration, content.next_id, content.sightings,
                                             std::move(landmarks));
}

api::LandmarkSummary summary_of(const std::string& name, const store::LandmarkHeader& header) {
  api::LandmarkSummary summary;
  summary.name = name;
  summary.robot_id = header.origin.robot_id;
  summary.software_version = header.origin.software_version;
  summary.map_name = header.origin.map_name;
  summary.calibration = header.calibration;
  summary.created_unix_s = header.origin.created_unix_s;
  summary.saved_unix_s = header.origin.saved_unix_s;
  summary.file_bytes = header.file_bytes;
  summary.revision = header.revision;
  summary.landmarks = static_cast<std::uint32_t>(header.landmarks);
  return summary;
}

api::LandmarkSummary problem_of(const std::string& name, const Error& error) {
  api::LandmarkSummary summary;
  summary.name = name;
  summary.problem = error.message;
  return summary;
}

std::string quoted(const std::string& name) { return "database '" + name + "'"; }

}  // namespace

LandmarkLibrary::LandmarkLibrary(LandmarkStorage storage)
    : storage_(std::move(storage)),
      files_(storage_.folder, {.ending = ".seekerlm",
                               .name = "database of landmarks",
                               .folder = "folder of databases",
                               .none = "none has been made yet ('seeker survey NAME')"}) {}

Status LandmarkLibrary::check_folder() const {
  return storage_.folder.empty()
             ? fail(Errc::kNotReady,
                    "this robot has no folder to keep databases of landmarks in; start it with --state FOLDER")
             : Status();
}

Status LandmarkLibrary::check_present(const std::string& name) const {
  const Status ok = check_folder();
  return ok ? files_.check_present(name) : ok;
}

Status LandmarkLibrary::check_free(const std::string& name, bool replace) const {
  const Status ok = check_folder();
  return ok ? files_.check_free(name, replace) : ok;
}

Result<api::LandmarkSummary> LandmarkLibrary::create(const std::string& name,
                                                     const localize::LandmarkDatabase& database,
                                                     const std::string& map_name, bool replace) {
  Status ok = check_free(name, replace);
  ok = ok ? files_.make_folder() : ok;
  const std::int64_t now = wall_unix_s();
  const store::LandmarkOrigin origin{storage_.robot_id, storage_.software_version, map_name, now, now};
  ok = ok ? store::write_landmark_file(files_.path_of(name), origin, content_of(database)) : ok;
  if (!ok) {
    return fail_with_context(quoted(name) + " was not kept", ok.error());
  }
  return inspect(name);
}

Result<api::LandmarkSummary> LandmarkLibrary::take(const std::filesystem::path& file, const std::string& name,
                                                   bool replace, bool check_only) {
  if (const Status ok = check_folder(); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  const Result<store::LandmarkFile> given = store::read_landmark_file(file);
  const Result<localize::LandmarkDatabase> database =
      given ? database_of(given->content) : tl::unexpected<Error>(given.error());
  if (!database) {
    return fail_with_context("the database that was sent", database.error());
  }
  if (check_only) {
    return summary_of(name, given->header);
  }
  const Result<store::LandmarkFile> present = store::read_landmark_file(files_.path_of(name));
  if (present && present->content == given->content && present->header.origin == given->header.origin) {
    return summary_of(name, present->header);
  }
  Status ok = check_free(name, replace);
  ok = ok ? files_.make_folder() : ok;
  ok = ok ? store::write_landmark_file(files_.path_of(name), given->header.origin, given->content) : ok;
  if (!ok) {
    return fail_with_context(quoted(name) + " was not kept", ok.error());
  }
  return inspect(name);
}

Result<std::filesystem::path> LandmarkLibrary::path_of(const std::string& name) const {
  const Status ok = check_present(name);
  return ok ? Result<std::filesystem::path>(files_.path_of(name)) : tl::unexpected<Error>(ok.error());
}

Result<LoadedLandmarks> LandmarkLibrary::load(const std::string& name) const {
  if (const Status ok = check_present(name); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  const Result<store::LandmarkFile> file = store::read_landmark_file(files_.path_of(name));
  if (!file) {
    return fail_with_context(quoted(name), file.error());
  }
  Result<localize::LandmarkDatabase> database = database_of(file->content);
  if (!database) {
    return fail_with_context(quoted(name), database.error());
  }
  return LoadedLandmarks{std::make_shared<const localize::LandmarkDatabase>(std::move(*database)),
                         summary_of(name, file->header)};
}

Result<std::vector<api::LandmarkSummary>> LandmarkLibrary::list() const {
  if (const Status ok = check_folder(); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  const Result<std::vector<std::string>> names = files_.names();
  if (!names) {
    return tl::unexpected<Error>(names.error());
  }
  std::vector<api::LandmarkSummary> all;
  all.reserve(names->size());
  for (const std::string& name : *names) {
    const Result<store::LandmarkHeader> header = store::read_landmark_header(files_.path_of(name));
    all.push_back(header ? summary_of(name, *header) : problem_of(name, header.error()));
  }
  return all;
}

Result<api::LandmarkSummary> LandmarkLibrary::inspect(const std::string& name) const {
  if (const Status ok = check_present(name); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  const Result<store::LandmarkHeader> header = store::read_landmark_header(files_.path_of(name));
  if (!header) {
    return fail_with_context(quoted(name), header.error());
  }
  return summary_of(name, *header);
}

Result<api::LandmarkSummary> LandmarkLibrary::update(const std::string& name,
                                                     const localize::LandmarkDatabase& database) {
  Status ok = check_present(name);
  ok = ok ? store::update_landmark_file(files_.path_of(name), wall_unix_s(), content_of(database)) : ok;
  if (!ok) {
    return fail_with_context(quoted(name) + " was not changed", ok.error());
  }
  return inspect(name);
}

Result<api::LandmarkSummary> LandmarkLibrary::revert(const std::string& name) {
  Status ok = check_present(name);
  ok = ok ? store::revert_landmark_file(files_.path_of(name), wall_unix_s()) : ok;
  if (!ok) {
    return fail_with_context(quoted(name) + " was not changed", ok.error());
  }
  return inspect(name);
}

Result<api::LandmarkSummary> LandmarkLibrary::prune(const std::string& name, int min_views) {
  const Result<LoadedLandmarks> loaded = load(name);
  if (!loaded) {
    return tl::unexpected<Error>(loaded.error());
  }
  localize::LandmarkDatabase database = *loaded->database;
  const std::size_t gone =
      database.erase_if([min_views](const localize::Landmark& landmark) { return landmark.seen < min_views; });
  if (database.empty()) {
    return fail(Errc::kRefused,
                "no landmark of '" + name + "' was seen in " + std::to_string(min_views) + " pictures; prune less");
  }
  return gone > 0 ? update(name, database) : inspect(name);
}

Status LandmarkLibrary::remove(const std::string& name) {
  const Status ok = check_folder();
  return ok ? files_.remove(name) : ok;
}

std::string LandmarkLibrary::in_use() const {
  const std::lock_guard lock(mutex_);
  return in_use_;
}

void LandmarkLibrary::set_in_use(const std::string& name) {
  const std::lock_guard lock(mutex_);
  in_use_ = name;
}

}  // namespace seeker::app
