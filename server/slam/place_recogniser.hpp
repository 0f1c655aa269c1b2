/// \file
/// Relocalisation: the place of some scans in a whole map, or the reason why they do not tell.
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
  double cloud_cell_m = 0.05;  ///< of points with like normals one is kept a cell for the final match
  /// The pyramid of a map too large for its cells gets larger ones, up to this.
  double max_cell_m = 0.4;
};

/// A map made ready for being searched: built once, used for many queries.
class PlaceMap {
 public:
  /// From scans at their poses in the frame `map`. Errors as LikelihoodPyramid::build(); kTooLarge is left for maps
  /// that do not fit with the largest cells either.
  [[nodiscard]] static Result<PlaceMap> build(const std::vector<SeenPoints>& seen_map,
                                              const PlaceMapParams& params = {});
  /// The pyramid's cells are larger than asked for: it says where to look, and detail_about() how well points fit
  /// there.
  [[nodiscard]] bool coarse() const { return !points_.empty(); }
  [[nodiscard]] const LikelihoodPyramid& pyramid() const { return pyramid_; }
  /// With the cells that were asked for, of what lies within a range; nothing where pyramid() has those itself, or
  /// where nothing lies there.
  [[nodiscard]] std::optional<LikelihoodPyramid> detail_about(const Point2& p_map, double range_m) const;
  [[nodiscard]] const ReferenceCloud& cloud() const { return *cloud_; }
  [[nodiscard]] const FreeSpace& free_space() const { return free_space_; }

 private:
  PlaceMap(LikelihoodPyramid pyramid, std::unique_ptr<ReferenceCloud> cloud, FreeSpace free_space);

  PyramidParams detail_;               ///< what was asked for
  std::vector<OrientedPoint> points_;  ///< of the map; none where the pyramid is what was asked for
  LikelihoodPyramid pyramid_;
  std::unique_ptr<ReferenceCloud> cloud_;
  FreeSpace free_space_;
};

/// A candidate after its refinement: what the points say about it.
struct PlaceCandidate {
  MatchResult match;   ///< pose, covariance, degenerate direction
  double score = 0.0;  ///< of the search
  Fit fit;
  Agreement agreement;
  /// What candidates are ranked by: mean likelihood of the points, less the share of beams through walls.
  [[nodiscard]] double support() const { return fit.all - agreement.through; }
};

/// Chosen on three buildings and three scanners (180 degrees with 180 and 360 beams, 240 degrees), so that scans of
/// another building, or of a part that was never mapped, are not taken for a place of the map.
struct JudgeParams {
  double min_fit = 0.5;          ///< of all points: people may hide half of the walls
  double min_standing = 0.75;    ///< of the points that do not lie in space known to be free
  double max_through = 0.12;     ///< beams through the map's walls
  double through_weight = 0.5;   ///< of a rival's further beams through walls, added to the lead over it
  double min_lead = 0.12;        ///< of the best candidate's fit over that of the next one
  double min_lead_cells = 15.0;  ///< lead times cells seen (GlobalSearchParams::thin_cell_m): small views prove little
  /// Sum of the lead and the mean of both fits: a poor fit, or one that people must explain, needs a large lead.
  double min_certainty = 1.05;
  /// A place that explains nearly all (mean of both fits of min_certainty - min_lead) and leads by at least this counts
  /// as a part of a witness, so that views which one after the other slightly prefer the same place prove it together.
  double weak_lead = 0.08;
};

/// What is asked of a place that the robot was at when it was seen last: others need not be excluded. Half of the view
/// may show what the map does not, for the robot may have gone on after the map was kept.
struct KeptPlaceParams {
  double min_fit = 0.35;
  double max_disagreement = 0.15;  ///< beams through walls, and points in free space
  double max_m = 0.7;              ///< it rolled on, or was pushed
  double max_rad = 1.2;            ///< it turned on
  double min_lead = 0.05;          ///< of the best place within that over the next one; no place about leads it by that
  /// Farther about it, at any heading, for the robot may have gone on after its place was kept: no other place there
  /// may do as well, and hardly anything may speak against it, although most of the view may be new.
  double about_m = 2.5;
  double about_min_fit = 0.45;
  double about_max_disagreement = 0.05;
  double about_min_lead = 0.2;
  double sigma_m = 0.5;  ///< of the place in the direction that scans say nothing about: it was kept a second ago
  double sigma_rad = 0.1;
};

enum class PlaceVerdict : std::uint8_t {
  kNone,       ///< nothing in the map looks like this
  kAmbiguous,  ///< more than one place does, or the points do not say enough: drive on and ask again with more scans
  kUnique,
};

[[nodiscard]] std::string_view to_string(PlaceVerdict verdict);

/// The verdict with its figures.
struct PlaceAnswer {
  PlaceVerdict verdict = PlaceVerdict::kNone;
  std::string_view reason;                 ///< one sentence
  std::vector<PlaceCandidate> candidates;  ///< best first
  double lead = 0.0;                       ///< of the first over the next one
  std::size_t cells = 0;                   ///< with points: how much was seen
  /// kAmbiguous since the points tell too little: nothing speaks for another place, nor against any.
  bool says_nothing = false;
  bool expected = false;  ///< where the robot was known to be: no second view is needed
  /// 0 to 1: how much this view says for the first candidate, 1 where that is unique.
  double weight = 0.0;
};

/// Verdict and reason from the candidates, whatever order they come in, and the number of cells with points.
[[nodiscard]] PlaceAnswer judge(std::vector<PlaceCandidate> candidates, std::size_t cells,
                                const JudgeParams& params = {});

struct PlaceParams {
  GlobalSearchParams search;
  MatchParams match;
  AgreementParams agreement;
  JudgeParams judge;
  KeptPlaceParams kept;
  std::size_t match_points = 360;  ///< of the final match
};

/// Search, refinement by ICP, contradiction, verdict.
class PlaceRecogniser {
 public:
  explicit PlaceRecogniser(const PlaceParams& params = {});

  /// Scans in the frame `base` of one pose, one scan or several put together by odometry.
  [[nodiscard]] PlaceAnswer locate(const PlaceMap& map, const std::vector<SeenPoints>& seen_base,
                                   const std::optional<SearchWindow>& window = std::nullopt) const;
  /// Whether the robot still stands at `map_T_base` (PlaceAnswer::expected), or farther about it. The covariance of the
  /// match says how well that is known in every direction.
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
