/// \file
/// The databases of landmarks in the state folder: what missions and estimators take from and give to the disk.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/api/landmarks.hpp"
#include "common/core/result.hpp"
#include "server/localize/landmark_database.hpp"
#include "server/store/landmark_file.hpp"
#include "server/store/named_files.hpp"

namespace seeker::app {

/// A database as it was read.
struct LoadedLandmarks {
  std::shared_ptr<const localize::LandmarkDatabase> database;
  api::LandmarkSummary summary;
};

/// Where databases are kept and what is written into them.
struct LandmarkStorage {
  std::filesystem::path folder;  ///< empty: this robot keeps none
  std::string robot_id;
  std::string software_version;
};

/// Safe to share between threads: every call opens its file. kNotReady where there is no folder.
class LandmarkLibrary {
 public:
  explicit LandmarkLibrary(LandmarkStorage storage);

  /// kRefused: there is such a database, and it is not to be replaced.
  [[nodiscard]] Status check_free(const std::string& name, bool replace) const;
  /// Keeps a new database, whole or not at all; `map_name` is the map whose frame it is in.
  [[nodiscard]] Result<api::LandmarkSummary> create(const std::string& name, const localize::LandmarkDatabase& database,
                                                    const std::string& map_name, bool replace);
  /// Keeps the database in `file`, which came from elsewhere, or only checks it: a new file is written from what was
  /// read, so that nothing else in it gets here. Changes nothing where the same database is kept already. Errors as of
  /// load() and create().
  [[nodiscard]] Result<api::LandmarkSummary> take(const std::filesystem::path& file, const std::string& name,
                                                  bool replace, bool check_only);
  /// Where a database is; kNotFound.
  [[nodiscard]] Result<std::filesystem::path> path_of(const std::string& name) const;
  /// Reads and checks a whole database; nothing is written. kNotFound, kCorrupt, kUnsupportedVersion, kIo.
  [[nodiscard]] Result<LoadedLandmarks> load(const std::string& name) const;
  /// By name; damaged ones with their problem.
  [[nodiscard]] Result<std::vector<api::LandmarkSummary>> list() const;
  [[nodiscard]] Result<api::LandmarkSummary> inspect(const std::string& name) const;
  /// Deletes landmarks that fewer pictures have shown. kRefused: nothing would be left.
  [[nodiscard]] Result<api::LandmarkSummary> prune(const std::string& name, int min_views);
  /// Makes a changed database the present version and keeps the one before; ids and calibration are those of the same
  /// database.
  [[nodiscard]] Result<api::LandmarkSummary> update(const std::string& name,
                                                    const localize::LandmarkDatabase& database);
  /// Back to the version before the last change. kNotReady: none is kept.
  [[nodiscard]] Result<api::LandmarkSummary> revert(const std::string& name);
  [[nodiscard]] Status remove(const std::string& name);

  /// The database that the robot's estimator goes by, which no client may change; empty: none.
  [[nodiscard]] std::string in_use() const;
  void set_in_use(const std::string& name);

 private:
  [[nodiscard]] Status check_folder() const;
  [[nodiscard]] Status check_present(const std::string& name) const;

  LandmarkStorage storage_;
  store::NamedFiles files_;
  mutable std::mutex mutex_;
  std::string in_use_;
};

}  // namespace seeker::app
