/// \file
/// All landmarks of a building: a value that surveys and updates create, and that localisers only read (spec
/// S2.3-S2.7).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "common/core/result.hpp"
#include "server/localize/landmark.hpp"
#include "server/localize/point_grid.hpp"

namespace seeker::localize {

/// Largest number of landmarks of a database.
inline constexpr std::size_t kMaxLandmarks = 1'000'000;
/// Largest absolute coordinate of a landmark.
inline constexpr double kMaxCoordinate_m = 10'000.0;

struct DatabaseStatistics {
  std::size_t landmarks = 0;
  std::size_t salient = 0;  ///< number of landmarks observed at least three times
  std::size_t views = 0;    ///< number of descriptors
  double mean_seen = 0.0;
  double median_sigma_m = 0.0;  ///< horizontal, in the less certain direction
  Point3 low = Point3::Zero();  ///< lower corner of the bounding box, in the frame map
  Point3 high = Point3::Zero();
};

class LandmarkDatabase {
 public:
  LandmarkDatabase() = default;
  explicit LandmarkDatabase(std::uint64_t calibration) : calibration_(calibration) {}
  /// Restores a database from the contents of a file. Fails with kCorrupt and the landmark's id for an id that is
  /// repeated, 0 or not below `next_id`, numbers that are not finite or out of range, an invalid information matrix,
  /// and no view or too many; fails with kTooLarge above kMaxLandmarks.
  [[nodiscard]] static Result<LandmarkDatabase> restore(std::uint64_t calibration, LandmarkId next_id,
                                                        std::uint64_t sightings, std::vector<Landmark> landmarks);

  /// Hash of the stereo geometry with which it was created (calibration_hash()).
  [[nodiscard]] std::uint64_t calibration() const { return calibration_; }
  [[nodiscard]] const std::vector<Landmark>& landmarks() const { return landmarks_; }
  [[nodiscard]] std::size_t size() const { return landmarks_.size(); }
  [[nodiscard]] bool empty() const { return landmarks_.empty(); }
  [[nodiscard]] const Landmark& at(std::size_t index) const { return landmarks_[index]; }
  [[nodiscard]] const Landmark* find(LandmarkId id) const;
  /// The id of the next new landmark: higher than any given before.
  [[nodiscard]] LandmarkId next_id() const { return next_id_; }
  /// Number of sightings that were added so far.
  [[nodiscard]] std::uint64_t sightings() const { return sightings_; }
  [[nodiscard]] DatabaseStatistics statistics() const;

  /// Numbers one more sighting; the landmarks it shows get this number as `last_seen`.
  std::uint64_t begin_sighting() { return ++sightings_; }
  /// Inserts a landmark and returns its new id.
  LandmarkId insert(Landmark landmark);
  /// Changes one landmark in place; its id is kept.
  void change(std::size_t index, const std::function<void(Landmark&)>& change);
  /// Erases landmarks and returns their number. Indices of the others change.
  std::size_t erase_if(const std::function<bool(const Landmark&)>& condition);

  /// Calls `visit(index)` for every landmark at most `radius_m` from p_map.
  template <class Visit>
  void for_near(const Point3& p_map, double radius_m, Visit visit) const {
    grid_.for_near(p_map, radius_m + kGridSlack_m, [&](std::size_t index) {
      if ((landmarks_[index].p_map - p_map).squaredNorm() <= radius_m * radius_m) {
        visit(index);
      }
    });
  }

  friend bool operator==(const LandmarkDatabase& a, const LandmarkDatabase& b) {
    return a.calibration_ == b.calibration_ && a.next_id_ == b.next_id_ && a.sightings_ == b.sightings_ &&
           a.landmarks_ == b.landmarks_;
  }

 private:
  /// A landmark may move by this distance before the index is rebuilt.
  static constexpr double kGridSlack_m = 0.05;
  static constexpr double kGridCell_m = 0.5;

  void rebuild_index();

  std::uint64_t calibration_ = 0;
  LandmarkId next_id_ = 1;
  std::uint64_t sightings_ = 0;
  std::vector<Landmark> landmarks_;
  std::vector<Point3> indexed_at_;  ///< position of each landmark in the index
  std::unordered_map<LandmarkId, std::size_t> by_id_;
  PointGrid grid_{kGridCell_m};
};

}  // namespace seeker::localize
