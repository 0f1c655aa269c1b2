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
};

/// A map made ready for being searched: built once, used for many queries.
class PlaceMap {
 public:
  /// From scans at their poses in the frame `map`. Errors as LikelihoodPyramid::build().
  [[nodiscard]] static Result<PlaceMap> build(const std::vector<SeenPoints>& seen_map,
                                              const PlaceMapParams& params = {});
  [[nodiscard]] const LikelihoodPyramid& pyramid() const { return pyramid_; }
  [[nodiscard]] const ReferenceCloud& cloud() const { return *cloud_; }
  [[nodiscard]] const FreeSpace& free_space() const { return free_space_; }

 private:
  PlaceMap(LikelihoodPyramid pyramid, std::unique_ptr<ReferenceCloud> cloud, FreeSpace free_space);

  LikelihoodPyramid pyramid_;
  std::unique_ptr<ReferenceCloud> cloud_;
  FreeSpace free_space_;
};

/// A candidate after its refinement: what the points say about it.
struct PlaceCandidate {
  MatchResult match;   ///< pose, covariance, degenerate direction
  double score = 0.0;  ///< of the search
  Agreement agreement;
  /// Share of the points on the map's surfaces, less the share that contradicts it: at most 1.
  [[nodiscard]] double support() const { return match.inlier_ratio - agreement.disagreement(); }
};

struct JudgeParams {
  std::size_t min_points = 40;
  double min_inliers = 0.6;   ///< of the best candidate
  double max_through = 0.12;  ///< beams through the map's walls
  double min_support = 0.45;
  double min_lead = 0.15;  ///< of the best candidate's support over the next one's
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
  std::vector<PlaceCandidate> candidates;  ///< best support first
  double lead = 0.0;                       ///< support of the first less that of the second
  bool complete = true;
};

/// Sets verdict and reason from the candidates, whatever order they come in.
[[nodiscard]] PlaceAnswer judge(std::vector<PlaceCandidate> candidates, std::size_t points,
                                const JudgeParams& params = {});

struct PlaceParams {
  GlobalSearchParams search;
  MatchParams match;
  AgreementParams agreement;
  JudgeParams judge;
  std::size_t match_points = 360;  ///< of the final match
};

/// Search, refinement by ICP, contradiction, verdict.
class PlaceRecogniser {
 public:
  explicit PlaceRecogniser(const PlaceParams& params = {});

  /// Scans in the frame `base` of one pose, one scan or several put together by odometry.
  [[nodiscard]] PlaceAnswer locate(const PlaceMap& map, const std::vector<SeenPoints>& seen_base,
                                   const std::optional<SearchWindow>& window = std::nullopt) const;

 private:
  PlaceParams params_;
  GlobalMatcher search_;
  ScanMatcher matcher_;
};

}  // namespace seeker::slam
