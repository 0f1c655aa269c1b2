#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"
#include "server/explore/place_strategy.hpp"
#include "server/explore/view_gain.hpp"
#include "server/nav/visibility.hpp"

namespace seeker::explore {
namespace {

constexpr int kSamples = 6;  ///< places about each opening, besides the one at it
constexpr double kSampleRadius_m = 1.0;

/// Next best view on the occupancy: unknown area in sight times exp(-lambda path length) (Gonzalez-Banos and Latombe
/// 2002).
class GainChooser final : public PlaceChooser {
 public:
  explicit GainChooser(const ExploreParams& params) : params_(params) {}

  [[nodiscard]] PlaceChoice choose(const PlaceInput& input) override {
    PlaceChoice choice;
    choice.decision.rule = "gain";
    double best_score = 0.0;
    const auto count = std::min(input.openings.size(), static_cast<std::size_t>(params_.viewpoints.max_candidates));
    for (std::size_t k = 0; k < count; ++k) {
      const Seen seen = best_view(input, input.openings[k]);
      choice.decision.candidates.push_back(candidate_of(seen.opening, seen.score));
      if (seen.area_m2 >= params_.viewpoints.min_gain_m2 && seen.score > best_score) {
        best_score = seen.score;
        choice.opening = seen.opening;
        choice.decision.chosen = static_cast<std::uint32_t>(k);
      }
    }
    choice.decision.why =
        choice.opening ? "most unknown floor in sight for its path length" : "no place shows enough new floor";
    return choice;
  }
  [[nodiscard]] bool wants_wall_ends() const override { return false; }
  [[nodiscard]] bool changes_its_mind() const override { return false; }

 private:
  struct Seen {
    Opening opening;
    double area_m2 = 0.0;
    double score = 0.0;
  };

  void consider(const PlaceInput& input, const Opening& opening, const Point2& place, Seen& best) const {
    const auto cost = input.costs.cost_to(place);
    if (!cost) {
      return;
    }
    const ViewGain gain = view_gain(input.floor.cost, place, params_.one_step.sensor);
    const double score = gain.area_m2 * std::exp(-params_.viewpoints.gain_lambda_1_m * *cost);
    if (score > best.score) {
      best = {opening, gain.area_m2, score};
      best.opening.map_T_view = {place.x(), place.y(), gain.heading_rad};
      best.opening.cost = *cost;
    }
  }

  [[nodiscard]] Seen best_view(const PlaceInput& input, const Opening& opening) const {
    Seen best{opening, 0.0, 0.0};
    consider(input, opening, opening.map_T_view.translation(), best);
    nav::VisibilityParams sight;
    sight.unknown_blocks = false;
    for (int k = 0; k < kSamples; ++k) {
      const double a = kTwoPi * k / kSamples;
      const Point2 place = opening.p_map + kSampleRadius_m * Point2(std::cos(a), std::sin(a));
      if (input.costs.cost_to(place) && nav::line_of_sight(input.floor.occupancy, place, opening.p_map, sight)) {
        consider(input, opening, place, best);
      }
    }
    return best;
  }

  ExploreParams params_;
};

}  // namespace

std::unique_ptr<PlaceChooser> make_gain_chooser(const ExploreParams& params) {
  return std::make_unique<GainChooser>(params);
}

}  // namespace seeker::explore
