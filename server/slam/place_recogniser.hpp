/// \file
/// Relocalisation: the pose of some scans in a whole map, or the reason why they do not determine it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "server/slam/global_matcher.hpp"
#include "server/slam/map_agreement.hpp"
#include "server/slam/scan_matcher.hpp"

namespace seeker::slam {

struct PlaceMapParams {
  PyramidParams pyramid;
  FreeSpaceParams free_space;
  /// Grid of the cloud for the final match, in which one point per cell and normal is kept.
  double cloud_cell_m = 0.05;
  /// Upper limit of the cell size, which is increased for maps too large for the cells of the pyramid.
  double max_cell_m = 0.4;
};

/// A map prepared for searches: built once, used for many queries.
class PlaceMap {
 public:
  /// Builds the map from scans at their poses in the frame `map`. Errors are those of LikelihoodPyramid::build();
  /// kTooLarge remains for maps that do not fit with the largest cells either.
  [[nodiscard]] static Result<PlaceMap> build(const std::vector<SeenPoints>& seen_map,
                                              const PlaceMapParams& params = {});
  /// Whether the pyramid's cells are larger than requested: it then gives candidates, and detail_about() evaluates how
  /// well points fit there.
  [[nodiscard]] bool coarse() const { return !points_.empty(); }
  [[nodiscard]] const LikelihoodPyramid& pyramid() const { return pyramid_; }
  /// A pyramid of the requested cell size of the surroundings within a range; no value where pyramid() has that cell
  /// size itself, or where the map is empty there.
  [[nodiscard]] std::optional<LikelihoodPyramid> detail_about(const Point2& p_map, double range_m) const;
  [[nodiscard]] const ReferenceCloud& cloud() const { return *cloud_; }
  [[nodiscard]] const FreeSpace& free_space() const { return free_space_; }

 private:
  PlaceMap(LikelihoodPyramid pyramid, std::unique_ptr<ReferenceCloud> cloud, FreeSpace free_space);

  PyramidParams detail_;               ///< requested parameters
  std::vector<OrientedPoint> points_;  ///< points of the map; empty where the pyramid has the requested cell size
  LikelihoodPyramid pyramid_;
  std::unique_ptr<ReferenceCloud> cloud_;
  FreeSpace free_space_;
};

/// A candidate after its refinement, with the evidence of the points.
struct PlaceCandidate {
  MatchResult match;   ///< pose, covariance, degenerate direction
  double score = 0.0;  ///< score of the search
  Fit fit;
  Agreement agreement;
  /// The criterion by which candidates are ranked: mean likelihood of the points minus the share of beams through
  /// walls.
  [[nodiscard]] double support() const { return fit.all - agreement.through; }
};

/// Chosen on three buildings and three scanners (180 degrees with 180 and 360 beams, 240 degrees), so that scans of
/// another building, or of a part that was never mapped, are not matched to a place of the map.
struct JudgeParams {
  double min_fit = 0.5;         ///< fit of all points: people may hide half of the walls
  double min_standing = 0.75;   ///< fit of the points that do not lie in known free space
  double max_through = 0.12;    ///< share of beams through the map's walls
  double through_weight = 0.5;  ///< weight of a rival's additional beams through walls, added to the lead over it
  double min_lead = 0.12;       ///< lead of the best candidate's fit over that of the next one
  /// Lead times observed cells (GlobalSearchParams::thin_cell_m): small views hold little evidence.
  double min_lead_cells = 15.0;
  /// Sum of the lead and the mean of both fits: a poor fit, or one that people must explain, needs a large lead.
  double min_certainty = 1.05;
  /// A place that explains nearly all points (mean of both fits of min_certainty - min_lead) and leads by at least this
  /// counts in part, so that views which consecutively prefer the same place slightly confirm it together.
  double weak_lead = 0.08;
};

/// Criteria for the place where the robot was observed last: other places need not be excluded. Half of the view may
/// differ from the map, since the robot may have driven on after the map was stored.
struct KeptPlaceParams {
  double min_fit = 0.35;
  double max_disagreement = 0.15;  ///< share of beams through walls and of points in free space
  double max_m = 0.7;              ///< largest displacement: the robot rolled on or was pushed
  double max_rad = 1.2;            ///< largest rotation of the robot meanwhile
  /// Lead of the best place within these limits over the next one; no place nearby leads it by that.
  double min_lead = 0.05;
  /// Farther from the stored pose, at any heading, since the robot may have driven on: no other place there may fit as
  /// well, and almost no evidence may contradict it, although most of the view may be new.
  double about_m = 2.5;
  double about_min_fit = 0.45;
  double about_max_disagreement = 0.05;
  double about_min_lead = 0.2;
  /// Standard deviation along a direction that scans do not constrain: the pose was stored a second ago.
  double sigma_m = 0.5;
  double sigma_rad = 0.1;
};

enum class PlaceVerdict : std::uint8_t {
  kNone,  ///< no place of the map fits
  /// More than one place fits, or the points hold too little information: drive on and try again with more scans.
  kAmbiguous,
  kUnique,
};

[[nodiscard]] std::string_view to_string(PlaceVerdict verdict);

/// The verdict with its evidence.
struct PlaceAnswer {
  PlaceVerdict verdict = PlaceVerdict::kNone;
  std::string_view reason;                 ///< one sentence
  std::vector<PlaceCandidate> candidates;  ///< best first
  double lead = 0.0;                       ///< lead of the first candidate over the next one
  std::size_t cells = 0;                   ///< number of cells with points: the extent of the view
  /// The verdict is kAmbiguous because the points hold too little information: no evidence for or against any place.
  bool says_nothing = false;
  bool expected = false;  ///< the pose is where the robot was known to be: no second view is needed
  /// Weight of this view for the first candidate, 0 to 1; 1 where that is unique.
  double weight = 0.0;
};

/// Verdict and reason from the candidates, in any order, and the number of cells with points.
[[nodiscard]] PlaceAnswer judge(std::vector<PlaceCandidate> candidates, std::size_t cells,
                                const JudgeParams& params = {});

struct PlaceParams {
  GlobalSearchParams search;
  MatchParams match;
  AgreementParams agreement;
  JudgeParams judge;
  KeptPlaceParams kept;
  std::size_t match_points = 360;  ///< number of points of the final match
};

/// Relocalisation by search, refinement by ICP, check for contradictions and verdict.
class PlaceRecogniser {
 public:
  explicit PlaceRecogniser(const PlaceParams& params = {});

  /// Locates scans in the frame `base` of one pose, of one scan or of several combined by odometry.
  [[nodiscard]] PlaceAnswer locate(const PlaceMap& map, const std::vector<SeenPoints>& seen_base,
                                   const std::optional<SearchWindow>& window = std::nullopt) const;
  /// Checks whether the robot still stands at `map_T_base` (PlaceAnswer::expected) or in its surroundings. The
  /// covariance of the match states how well the pose is known in every direction.
  [[nodiscard]] PlaceAnswer confirm(const PlaceMap& map, const std::vector<SeenPoints>& seen_base,
                                    const Pose2& map_T_base) const;

 private:
  struct Query;
  [[nodiscard]] Pose2 start_in(const LikelihoodPyramid& detail, const Query& query, const Pose2& coarse,
                               double cell_m) const;
  [[nodiscard]] PlaceCandidate refine(const PlaceMap& map, const Query& query, const Pose2& start) const;
  [[nodiscard]] std::vector<PlaceCandidate> refine_all(const PlaceMap& map, const Query& query,
                                                       const GlobalSearchResult& found) const;
  [[nodiscard]] bool agrees(const PlaceCandidate& candidate, const Pose2& map_T_base) const;
  void accept(PlaceCandidate candidate, PlaceAnswer& answer) const;
  [[nodiscard]] bool agrees_near(const PlaceAnswer& near, const Pose2& map_T_base) const;
  [[nodiscard]] bool stands_out(const PlaceAnswer& about) const;
  [[nodiscard]] PlaceAnswer ranked(const PlaceMap& map, const Query& query, const SearchWindow& window) const;

  PlaceParams params_;
  GlobalMatcher search_;
  ScanMatcher matcher_;
};

}  // namespace seeker::slam
