/// \file
/// Update of a database while the building changes (spec S2.10): observations of a drive become landmarks, and
/// landmarks that should have been observed but never were are removed. The database in use is not changed: an update
/// is staged as a new value, to be committed or discarded.
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "server/localize/stereo_localiser.hpp"
#include "server/localize/survey.hpp"

namespace seeker::localize {

struct UpdateParams {
  DatabaseParams database;  ///< parameters of the landmarks that a drive adds
  /// Spec S2.10: a landmark is removed after so many misses in a row. Otherwise by the odds that it still exists.
  bool count_misses = false;
  int max_misses = 10;      ///< n_del
  double seen_there = 0.3;  ///< share of frames that show an existing landmark in view
  double seen_gone = 0.02;  ///< share of frames that show a removed one, by false matches
  double remove_log_odds = -3.0;
  double max_log_odds = 3.0;  ///< upper limit of the log odds
  /// A feature closer to the eye within this distance in the picture occludes a landmark.
  double occlusion_px = 25.0;
  double occlusion_ratio = 1.25;               ///< disparity of the occluding feature over that of the landmark
  double min_move_m = 0.10;                    ///< displacement after which a frame counts as new evidence
  double min_rotation_rad = deg_to_rad(10.0);  ///< or rotation after which it does
  /// Frames with a less certain position create no landmarks; 0: all do. Landmarks of one frame share the error of its
  /// pose, but a localiser assumes that their errors are independent.
  double max_teaching_sigma_m = 0.01;
  double max_removed_share = 0.5;  ///< an update that would remove a larger share is refused

  friend bool operator==(const UpdateParams&, const UpdateParams&) = default;
};

/// The parameters of spec S2.10 as printed.
[[nodiscard]] UpdateParams paper_update_params();
/// Fails with kInvalidArgument and the field's name.
[[nodiscard]] Status validate(const UpdateParams& params);

/// Summary of an update.
struct UpdateCounts {
  int frames = 0;      ///< number of frames that were used
  int dynamic = 0;     ///< number of landmarks created on the drive
  int duplicates = 0;  ///< number of these that were known already
  int sparsified = 0;  ///< number of these that the sparsity rule refused
  int added = 0;
  int removed = 0;
  std::size_t before = 0;
  std::size_t after = 0;  ///< before + added - removed

  friend bool operator==(const UpdateCounts&, const UpdateCounts&) = default;
};

/// A new version of a database that is not in use yet.
struct StagedUpdate {
  LandmarkDatabase database;
  UpdateCounts counts;
};

/// Collects the evidence of the frames of a drive about a database. The poses of a drive depend on the same landmarks
/// and on each other: they are adjusted (adjust_poses()) before their observations become landmarks, since otherwise a
/// drive that began uncertain would store its initial error.
class DatabaseUpdate {
 public:
  /// Requires valid arguments (asserted).
  DatabaseUpdate(const StereoGeometry& geometry, const UpdateParams& params);

  /// Takes one frame with the localiser's pose and its expected and matched landmarks. Only frames while LOCALISED are
  /// used: false where this one was not.
  bool observe(const LandmarkDatabase& database, const Sighting& sighting, const LocaliserStep& step);
  [[nodiscard]] int frames() const { return frames_; }
  /// Whether the next frame will take long, since enough frames for an adjustment are collected. It is better to call
  /// stage() then.
  [[nodiscard]] bool full() const;
  /// The update of the database against which the frames were matched. Fails with kNotReady when no frame was used, and
  /// with kRefused when more than the allowed share would be removed (with both counts), since then the pose was
  /// probably wrong; otherwise the building should be surveyed again.
  [[nodiscard]] Result<StagedUpdate> stage(const LandmarkDatabase& database) const;
  /// Discards all frames, for the next drive.
  void clear();

 private:
  /// Evidence of the drive about one landmark.
  struct Tally {
    int hits = 0;
    int expected = 0;
    int misses = 0;  ///< number of misses in a row, including those stored in the database
    double log_odds = 0.0;
  };

  /// A frame, its matches with the database, and the motion of the eye since the previous used frame.
  struct Frame {
    Sighting sighting;
    std::vector<FrameMatch> matches;
    std::optional<UncertainPose> last_T_eye;
  };

  [[nodiscard]] bool moved(const Pose2& map_T_eye) const;
  [[nodiscard]] bool hidden(const Landmark& landmark, const Sighting& sighting) const;
  void tally(const LandmarkDatabase& database, const Sighting& sighting, const LocaliserStep& step);
  void apply_tallies(LandmarkDatabase& database) const;
  [[nodiscard]] bool is_gone(const Landmark& landmark) const;
  [[nodiscard]] Status learn(const LandmarkDatabase& database, std::vector<Frame> frames, SurveyBuilder& dynamic) const;
  [[nodiscard]] std::vector<std::size_t> by_worth(const LandmarkDatabase& dynamic) const;
  void add_new(const LandmarkDatabase& dynamic, LandmarkDatabase& database, UpdateCounts& counts) const;

  StereoGeometry geometry_;
  UpdateParams params_;
  SurveyBuilder dynamic_;
  std::vector<Frame> recent_;  ///< the last part of the drive, not yet in `dynamic_`
  std::unordered_map<LandmarkId, Tally> tallies_;
  std::optional<Pose2> last_eye_;
  std::optional<UncertainPose> last_T_eye_;  ///< motion since the last used frame; no value after a jump
  int frames_ = 0;
};

}  // namespace seeker::localize
