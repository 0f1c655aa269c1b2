#include "server/explore/one_step.hpp"

#include <algorithm>
#include <cmath>

#include "server/explore/objective.hpp"

namespace seeker::explore {
namespace {

/// Without a joint filter so many walls are predicted.
constexpr std::size_t kMaxLooseWalls = 128;
/// Beyond the sensor's range and the step, for what is about to come into view.
constexpr double kReachMargin_m = 0.5;
constexpr double kPreferStraight_s = 0.05;  ///< of a hall: metres per second lost for a radian per second of rotation

Belief belief_of(const StrategyInput& input, const std::vector<MapSegment>& segments) {
  return input.belief ? Belief(*input.belief) : Belief(input.map_T_base, input.covariance, segments, kMaxLooseWalls);
}

/// In a hall there is nothing to predict: fast and straight.
void score_hall(ExploreDecision& decision) {
  for (DecisionCandidate& candidate : decision.candidates) {
    candidate.score = candidate.control.v_m_s - kPreferStraight_s * std::abs(candidate.control.omega_rad_s);
  }
  decision.why = "no wall is within range: straight ahead until one is seen";
}

void choose_best(OneStepChoice& choice) {
  for (std::uint32_t k = 0; k < choice.decision.candidates.size(); ++k) {
    const DecisionCandidate& candidate = choice.decision.candidates[k];
    const auto& chosen = choice.decision.chosen;
    if (candidate.refused.empty() && (!chosen || candidate.score > choice.decision.candidates[*chosen].score)) {
      choice.decision.chosen = k;
    }
  }
  if (choice.decision.chosen) {
    choice.control = choice.decision.candidates[*choice.decision.chosen].control;
  } else {
    choice.decision.why = "no control may be held: obstacles block every one";
  }
}

}  // namespace

std::vector<Twist2> controls_of(const OneStepParams& params) {
  std::vector<Twist2> controls;
  controls.reserve(params.v_m_s.size() * params.omega_rad_s.size());
  for (const double v_m_s : params.v_m_s) {
    for (const double omega_rad_s : params.omega_rad_s) {
      if (v_m_s != 0.0 || omega_rad_s != 0.0) {
        controls.push_back({v_m_s, omega_rad_s});
      }
    }
  }
  return controls;
}

double longest_step_m(const OneStepParams& params) {
  double fastest_m_s = 0.0;
  for (const double v_m_s : params.v_m_s) {
    fastest_m_s = std::max(fastest_m_s, std::abs(v_m_s));
  }
  return fastest_m_s * params.observation_period_s;
}

SightScene scene_around(const StrategyInput& input, const std::vector<MapSegment>& segments,
                        const OneStepParams& params, const std::shared_ptr<const nav::FloorView>& floor) {
  const double reach_m = params.sensor.range_m + longest_step_m(params) + kReachMargin_m;
  return {segments, input.map_T_base.translation(), reach_m, params,
          params.use_floor && floor ? &floor->cost.states() : nullptr};
}

OneStepChoice choose_one_step(const StrategyInput& input, const std::vector<MapSegment>& segments,
                              const OneStepParams& params) {
  const auto view = input.floors.view();
  const std::shared_ptr<const nav::FloorView> floor = view ? *view : nullptr;
  const SightScene scene = scene_around(input, segments, params, floor);
  const ControlCheck check(input, scene, params.swept_radius_m, longest_step_m(params), params.use_floor);
  OneStepChoice choice;
  choice.decision.rule = "one-step";
  choice.sees_walls = !scene.walls().empty();
  choice.gains_nothing = choice.sees_walls;
  std::vector<PredictedMotion> motions;
  for (const Twist2& control : controls_of(params)) {
    motions.push_back(predict_motion(control, params.observation_period_s, params.odometry));
    DecisionCandidate candidate;
    candidate.map_T_base = input.map_T_base * motions.back().increment;
    candidate.control = control;
    candidate.path_m = std::abs(control.v_m_s) * params.observation_period_s;
    candidate.refused = check.refusal(control, params.observation_period_s);
    choice.decision.candidates.push_back(candidate);
  }
  if (!choice.sees_walls) {
    score_hall(choice.decision);
    choose_best(choice);
    return choice;
  }
  const std::vector<Terms> terms = evaluate(input.map_T_base, motions, scene, belief_of(input, segments), params);
  for (std::size_t k = 0; k < terms.size(); ++k) {
    DecisionCandidate& candidate = choice.decision.candidates[k];
    candidate.lg_j1 = terms[k].lg_j1;
    candidate.lg_j21 = terms[k].lg_j21;
    candidate.lg_j22 = terms[k].lg_j22;
    candidate.score = terms[k].score;
    const bool available = candidate.refused.empty();
    choice.gains_nothing = choice.gains_nothing && (!available || terms[k].gains_nothing(params.log_floor));
  }
  choice.decision.why = choice.gains_nothing ? "no step shows more of a wall; the most certain one"
                                             : "certainty, longer walls and more ends together";
  choose_best(choice);
  return choice;
}

}  // namespace seeker::explore
