/// \file
/// Keeping a database true while the building changes (spec S2.10): what is seen on a drive becomes landmarks, and what
/// should have been seen and never was is given up. Nothing changes in the database in use: an update is staged as a
/// new value, to be committed or thrown away.
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "server/localize/stereo_localiser.hpp"
#include "server/localize/survey.hpp"

namespace seeker::localize {

struct UpdateParams {
  DatabaseParams database;  ///< of the landmarks that a drive adds
  /// Spec S2.10: a landmark goes after so many misses in a row. Else by the odds that it is still there.
  bool count_misses = false;
  int max_misses = 10;      ///< n_del
  double seen_there = 0.3;  ///< share of frames that show a landmark which is there and in view
  double seen_gone = 0.02;  ///< and one that is not: false matches
  double remove_log_odds = -3.0;
  double max_log_odds = 3.0;               ///< so much trust at most is built up
  double occlusion_px = 25.0;              ///< a feature nearer to the eye than this around a landmark hides it
  double occlusion_ratio = 1.25;           ///< disparity of what hides over that of the landmark
  double min_move_m = 0.10;                ///< frames count as new evidence after so much motion,
  double min_turn_rad = deg_to_rad(10.0);  ///< or so much turning
  /// Frames from places less certain than this make no landmarks; 0: all do. Landmarks of one frame share its pose's
  /// error, and a localiser takes them for as many that err each on their own.
  double max_teaching_sigma_m = 0.01;
  double max_removed_share = 0.5;  ///< an update that would remove more is refused

  friend bool operator==(const UpdateParams&, const UpdateParams&) = default;
};

/// Spec S2.10 as printed.
[[nodiscard]] UpdateParams paper_update_params();
/// kInvalidArgument with the field's name.
[[nodiscard]] Status validate(const UpdateParams& params);

/// What an update does.
struct UpdateCounts {
  int frames = 0;      ///< that went into it
  int dynamic = 0;     ///< landmarks that the drive made
  int duplicates = 0;  ///< of these, known already
  int sparsified = 0;  ///< refused by the sparsity rule
  int added = 0;
  int removed = 0;
  std::size_t before = 0;
  std::size_t after = 0;  ///< before + added - removed

  friend bool operator==(const UpdateCounts&, const UpdateCounts&) = default;
};

/// A new version of a database that nobody uses yet.
struct StagedUpdate {
  LandmarkDatabase database;
  UpdateCounts counts;
};

/// Gathers what the frames of a drive say about a database. The poses of a drive lean on the same landmarks and on each
/// other: they are made to agree (adjust_poses()) before what they show becomes landmarks, else a drive that began
/// uncertain would write its first error down.
class DatabaseUpdate {
 public:
  /// Asserts that the arguments are valid.
  DatabaseUpdate(const StereoGeometry& geometry, const UpdateParams& params);

  /// One frame with the localiser's pose and what it expected and matched there. Only frames while LOCALISED teach
  /// anything: false where this one was not taken.
  bool observe(const LandmarkDatabase& database, const Sighting& sighting, const LocaliserStep& step);
  [[nodiscard]] int frames() const { return frames_; }
  /// The next frame will take long: as many as are made to agree at a time have come together. Better stage() now.
  [[nodiscard]] bool full() const;
  /// The update of the database that the frames were matched against. kNotReady: no frame taught anything; kRefused:
  /// it would remove more than the share allowed (with both counts): rather the pose was wrong, or survey anew.
  [[nodiscard]] Result<StagedUpdate> stage(const LandmarkDatabase& database) const;
  /// Forgets everything, for the next drive.
  void clear();

 private:
  /// What the drive says about one landmark.
  struct Tally {
    int hits = 0;
    int expected = 0;
    int misses = 0;  ///< in a row, those of the database before included
    double log_odds = 0.0;
  };

  /// A frame, what it showed of the database, and how far the eye is from the frame taken before.
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
  std::vector<Frame> recent_;  ///< the drive's last part, not in `dynamic_` yet
  std::unordered_map<LandmarkId, Tally> tallies_;
  std::optional<Pose2> last_eye_;
  std::optional<UncertainPose> last_T_eye_;  ///< since the last frame taken; nothing after a leap
  int frames_ = 0;
};

}  // namespace seeker::localize
