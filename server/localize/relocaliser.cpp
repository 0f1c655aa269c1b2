#include "server/localize/relocaliser.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "common/core/assert.hpp"

namespace seeker::localize {
namespace {

/// A match that votes: where the eye saw it, where the landmark stands, and how far the two may differ.
struct Voter {
  Pairing pair;
  Point2 p_eye;
  Point2 p_map;
  Matrix2 weight;  ///< inverse covariance of the difference, in the frame eye
  double sigma_m = 0.0;
};

/// A place and how many features it explains.
struct Place {
  Pose2 map_T_eye;
  int inliers = 0;
};

class Search {
 public:
  Search(const StereoGeometry& geometry, const LandmarkMap& map, std::span<const vision::StereoFeature> features,
         std::span<const EyeFeature> lifted, const LocaliserParams& params)
      : geometry_(geometry), map_(map), features_(features), lifted_(lifted), params_(params) {}

  RelocaliseAnswer run(Rng& rng);

 private:
  void find_voters();
  void add_voter(const Pairing& pair);
  [[nodiscard]] std::vector<Place> try_pairs(int attempts, Rng& rng) const;
  [[nodiscard]] std::optional<Pose2> place_of(const Voter& a, const Voter& b) const;
  [[nodiscard]] bool agrees(const Pose2& map_T_eye, const Voter& voter) const;
  [[nodiscard]] int count(const Pose2& map_T_eye) const;
  /// One match a feature, the most alike.
  [[nodiscard]] std::vector<Pairing> inliers_at(const Pose2& map_T_eye) const;
  [[nodiscard]] EyeBelief refine(const Pose2& map_T_eye) const;
  [[nodiscard]] EyeBelief fit(const Pose2& map_T_eye, std::span<const RangeBearing> seen) const;
  [[nodiscard]] std::vector<RangeBearing> seen_by(const std::vector<Pairing>& pairs) const;
  [[nodiscard]] double leaning_m(const RelocaliseAnswer& answer) const;
  [[nodiscard]] bool is_rival(const Pose2& a, const Pose2& b) const {
    return distance_m(a, b) > params_.relocalise.rival_m ||
           std::abs(wrap_angle(a.theta_rad - b.theta_rad)) > params_.relocalise.rival_rad;
  }
  [[nodiscard]] int rival_of(const Pose2& best, Rng& rng) const;
  [[nodiscard]] int cells_of(const std::vector<Pairing>& inliers) const;
  [[nodiscard]] double likeness_of(const std::vector<Pairing>& inliers) const;
  void judge(RelocaliseAnswer& answer) const;

  const StereoGeometry& geometry_;
  const LandmarkMap& map_;
  std::span<const vision::StereoFeature> features_;
  std::span<const EyeFeature> lifted_;
  const LocaliserParams& params_;
  std::vector<Voter> voters_;
};

/// The feature most similar to a chosen landmark must be the one that chose it: mutually nearest, spec S2.5.
void Search::find_voters() {
  std::vector<vision::Descriptor> queries;
  queries.reserve(lifted_.size());
  for (const EyeFeature& feature : lifted_) {
    queries.push_back(features_[feature.feature].descriptor);
  }
  const auto alike = alike_landmarks(map_.table, queries, params_.metric);
  std::vector<Pairing> suits;
  std::vector<vision::Descriptor> chosen;
  for (std::size_t i = 0; i < alike.size(); ++i) {
    for (const AlikeLandmark& landmark : alike[i]) {
      const double limit =
          std::min(params_.relocalise.max_distance, params_.relocalise.ambiguity * alike[i].front().distance);
      if (landmark.distance <= limit) {
        suits.push_back({i, landmark.landmark, landmark.distance});
        chosen.push_back(*landmark.view);
      }
    }
  }
  const auto back = vision::nearest_two(chosen, queries, params_.metric);
  for (std::size_t k = 0; k < suits.size(); ++k) {
    if (back[k].best == static_cast<std::int32_t>(suits[k].point)) {
      add_voter(suits[k]);
    }
  }
}

/// Unless heights or scales, which both know, speak against it.
void Search::add_voter(const Pairing& pair) {
  const EyeFeature& feature = lifted_[pair.point];
  const Matrix3& own = map_.covariances[pair.landmark];
  const Point3& p_map = map_.at(pair.landmark).p_map;
  if (!heights_agree(feature, map_, pair.landmark, params_.relocalise.height_tolerance_m, params_) ||
      !scales_agree(feature, map_.at(pair.landmark), params_.relocalise.max_scale_ratio)) {
    return;
  }
  const double floor_m2 = params_.measurement.range_floor_m * params_.measurement.range_floor_m;
  const Matrix2 covariance = feature.eye.covariance.topLeftCorner<2, 2>() +
                             (0.5 * own.topLeftCorner<2, 2>().trace() + floor_m2) * Matrix2::Identity();
  voters_.push_back(
      {pair, feature.eye.p.head<2>(), p_map.head<2>(), covariance.inverse(), std::sqrt(covariance.trace())});
}

/// The rigid motion that lays two seen points on their landmarks, if their distances agree.
std::optional<Pose2> Search::place_of(const Voter& a, const Voter& b) const {
  const Point2 eye = b.p_eye - a.p_eye;
  const Point2 map = b.p_map - a.p_map;
  const double length_m = eye.norm();
  const double tolerance_m = params_.tracking.window_sigmas * std::hypot(a.sigma_m, b.sigma_m);
  if (length_m < params_.relocalise.min_separation_m || map.norm() < params_.relocalise.min_separation_m ||
      std::abs(length_m - map.norm()) > tolerance_m) {
    return std::nullopt;
  }
  Pose2 map_T_eye{0.0, 0.0, wrap_angle(std::atan2(map.y(), map.x()) - std::atan2(eye.y(), eye.x()))};
  // The nearer point is the more certain one: the motion lays it exactly.
  const Voter& anchor = a.sigma_m <= b.sigma_m ? a : b;
  const Point2 shift = anchor.p_map - map_T_eye * anchor.p_eye;
  map_T_eye.x_m = shift.x();
  map_T_eye.y_m = shift.y();
  return map_T_eye;
}

bool Search::agrees(const Pose2& map_T_eye, const Voter& voter) const {
  const Point2 offset = voter.p_map - map_T_eye.translation();
  const double c = std::cos(map_T_eye.theta_rad);
  const double s = std::sin(map_T_eye.theta_rad);
  const Point2 difference = Point2(c * offset.x() + s * offset.y(), c * offset.y() - s * offset.x()) - voter.p_eye;
  return difference.dot(voter.weight * difference) <= params_.relocalise.gate_chi2;
}

int Search::count(const Pose2& map_T_eye) const {
  int inliers = 0;
  std::size_t last_point = lifted_.size();
  for (const Voter& voter : voters_) {
    // Voters of one feature stand one after the other: it counts once.
    if (voter.pair.point != last_point && agrees(map_T_eye, voter)) {
      ++inliers;
      last_point = voter.pair.point;
    }
  }
  return inliers;
}

std::vector<Pairing> Search::inliers_at(const Pose2& map_T_eye) const {
  std::vector<Pairing> inliers;
  for (const Voter& voter : voters_) {
    if (!agrees(map_T_eye, voter)) {
      continue;
    }
    if (inliers.empty() || inliers.back().point != voter.pair.point) {
      inliers.push_back(voter.pair);
    } else if (voter.pair.distance < inliers.back().distance) {
      inliers.back() = voter.pair;
    }
  }
  return inliers;
}

std::vector<Place> Search::try_pairs(int attempts, Rng& rng) const {
  std::vector<Place> places;
  if (voters_.size() < 2) {
    return places;
  }
  for (int i = 0; i < attempts; ++i) {
    const Voter& a = voters_[rng.below(voters_.size())];
    const Voter& b = voters_[rng.below(voters_.size())];
    const auto place = place_of(a, b);
    if (!place) {
      continue;
    }
    const int inliers = count(*place);
    constexpr int kMoreThanThePair = 3;
    if (inliers >= kMoreThanThePair) {
      places.push_back({*place, inliers});
    }
  }
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.inliers > b.inliers; });
  return places;
}

std::vector<RangeBearing> Search::seen_by(const std::vector<Pairing>& pairs) const {
  std::vector<RangeBearing> seen;
  seen.reserve(pairs.size());
  for (const Pairing& pair : pairs) {
    seen.push_back(with_landmark(lifted_[pair.point], map_, pair.landmark, 1.0, params_));
  }
  return seen;
}

/// Least squares, from hardly any knowledge of the place.
EyeBelief Search::fit(const Pose2& map_T_eye, std::span<const RangeBearing> seen) const {
  constexpr double kWideSigma_m = 1.0;
  constexpr double kWideSigma_rad = 0.5;
  EyeBelief belief;
  belief.map_T_eye = map_T_eye;
  belief.covariance = Eigen::Vector4d(std::pow(kWideSigma_m, 2), std::pow(kWideSigma_m, 2), std::pow(kWideSigma_rad, 2),
                                      std::pow(params_.disparity_offset_sigma_px, 2))
                          .asDiagonal();
  static_cast<void>(update_together(belief, seen, params_.batch));
  return belief;
}

/// Refines the pose; the inliers are chosen again in each round.
EyeBelief Search::refine(const Pose2& map_T_eye) const {
  constexpr int kRounds = 3;
  EyeBelief belief;
  belief.map_T_eye = map_T_eye;
  for (int round = 0; round < kRounds; ++round) {
    belief = fit(belief.map_T_eye, seen_by(inliers_at(belief.map_T_eye)));
  }
  return belief;
}

/// How far the place moves when the match that it leans on most is left out, or how uncertain it is then. Far landmarks
/// side by side leave the eye free to swing around them: a single near one then determines the pose, right or wrong.
double Search::leaning_m(const RelocaliseAnswer& answer) const {
  std::vector<RangeBearing> seen = seen_by(answer.inliers);
  const Pose2& place = answer.belief.map_T_eye;
  double most_m = 0.0;
  for (RangeBearing& left_out : seen) {
    std::swap(left_out, seen.back());
    const EyeBelief without = fit(place, std::span(seen).first(seen.size() - 1));
    std::swap(left_out, seen.back());
    const Matrix2 covariance = without.covariance.topLeftCorner<2, 2>();
    most_m = std::max({most_m, distance_m(place, without.map_T_eye), largest_sigma(covariance)});
  }
  return most_m;
}

/// What the matches that do not agree with the best place say: the most that agree on another one.
int Search::rival_of(const Pose2& best, Rng& rng) const {
  constexpr int kShare = 3;           // of the attempts: a rival worth the name is found with fewer
  constexpr std::size_t kAsked = 10;  // more than one may slide to the best place
  Search others(geometry_, map_, features_, lifted_, params_);
  std::copy_if(voters_.begin(), voters_.end(), std::back_inserter(others.voters_),
               [&](const Voter& voter) { return !agrees(best, voter); });
  const std::vector<Place> places = others.try_pairs(params_.relocalise.attempts / kShare, rng);
  for (std::size_t i = 0; i < std::min(kAsked, places.size()); ++i) {
    const EyeBelief refined = others.refine(places[i].map_T_eye);
    if (is_rival(refined.map_T_eye, best)) {
      return std::max(places[i].inliers, others.count(refined.map_T_eye));
    }
  }
  return 0;
}

int Search::cells_of(const std::vector<Pairing>& inliers) const {
  const RelocaliseParams& p = params_.relocalise;
  std::set<std::pair<int, int>> cells;
  for (const Pairing& pair : inliers) {
    const vision::Keypoint& at = features_[lifted_[pair.point].feature].left;
    cells.emplace(
        static_cast<int>(at.u_px * static_cast<float>(p.cell_columns) / static_cast<float>(geometry_.width_px)),
        static_cast<int>(at.v_px * static_cast<float>(p.cell_rows) / static_cast<float>(geometry_.height_px)));
  }
  return static_cast<int>(cells.size());
}

double Search::likeness_of(const std::vector<Pairing>& inliers) const {
  return std::accumulate(inliers.begin(), inliers.end(), 0.0, [this](double sum, const Pairing& pair) {
    return sum + 1.0 - pair.distance / params_.relocalise.max_distance;
  });
}

void Search::judge(RelocaliseAnswer& answer) const {
  const RelocaliseParams& p = params_.relocalise;
  const auto found = static_cast<int>(answer.inliers.size());
  const std::string figures = std::to_string(found) + " of " + std::to_string(answer.candidates) + " matches agree";
  const double many = p.many_inliers + p.many_share * answer.candidates;
  const Matrix2 place = answer.belief.covariance.topLeftCorner<2, 2>();
  const double sigma_m = largest_sigma(place);
  if (found < p.min_inliers) {
    answer.verdict = RelocaliseVerdict::kNothing;
    answer.reason = figures + ", " + std::to_string(p.min_inliers) + " are needed; rotate the robot or drive on";
  } else if (found < p.min_lead * answer.rival_inliers) {
    answer.verdict = RelocaliseVerdict::kAmbiguous;
    answer.reason = figures + ", " + std::to_string(answer.rival_inliers) +
                    " on another place; drive on until the places can be distinguished";
  } else if (answer.likeness < p.min_likeness && found < many) {
    answer.verdict = RelocaliseVerdict::kNothing;
    answer.reason = figures + ", but are hardly alike (" + std::to_string(answer.likeness) + ", " +
                    std::to_string(p.min_likeness) + " is needed); rotate the robot or drive on";
  } else if (answer.cells < p.min_cells || sigma_m > p.max_sigma_m) {
    answer.verdict = RelocaliseVerdict::kVague;
    answer.reason = figures + ", but in " + std::to_string(answer.cells) + " parts of the picture, sigma " +
                    std::to_string(sigma_m) + " m; rotate the robot to where more can be seen";
  } else if (const double leaning = leaning_m(answer); leaning > p.max_sigma_m) {
    answer.verdict = RelocaliseVerdict::kVague;
    answer.reason = figures + ", but without one of them the place is another by " + std::to_string(leaning) +
                    " m; rotate the robot to where more can be seen";
  } else {
    answer.verdict = RelocaliseVerdict::kFound;
    answer.reason = figures;
  }
}

RelocaliseAnswer Search::run(Rng& rng) {
  RelocaliseAnswer answer;
  find_voters();
  answer.candidates = static_cast<int>(voters_.size());
  const std::vector<Place> places = try_pairs(params_.relocalise.attempts, rng);
  if (places.empty()) {
    answer.reason = std::to_string(voters_.size()) + " features look like landmarks, and no place explains them; " +
                    "rotate the robot or drive on";
    return answer;
  }
  answer.belief = refine(places.front().map_T_eye);
  answer.inliers = inliers_at(answer.belief.map_T_eye);
  answer.likeness = likeness_of(answer.inliers);
  answer.cells = cells_of(answer.inliers);
  answer.rival_inliers = rival_of(answer.belief.map_T_eye, rng);
  judge(answer);
  return answer;
}

}  // namespace

std::string_view to_string(RelocaliseVerdict verdict) {
  switch (verdict) {
    case RelocaliseVerdict::kFound: return "found";
    case RelocaliseVerdict::kNothing: return "nothing";
    case RelocaliseVerdict::kAmbiguous: return "ambiguous";
    case RelocaliseVerdict::kVague: return "vague";
  }
  SEEKER_ASSERT(false);
  return "";
}

RelocaliseAnswer relocalise(const StereoGeometry& geometry, const LandmarkMap& map,
                            std::span<const vision::StereoFeature> features, std::span<const EyeFeature> lifted,
                            const LocaliserParams& params, Rng& rng) {
  return Search(geometry, map, features, lifted, params).run(rng);
}

}  // namespace seeker::localize
