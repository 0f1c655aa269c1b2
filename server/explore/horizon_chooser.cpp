#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/core/text.hpp"
#include "server/explore/horizon_views.hpp"
#include "server/explore/leg_forecast.hpp"

namespace seeker::explore {
namespace {

/// Beam search over sequences of drives, by the objective of spec S1.11 for a whole sequence, with the path length
/// and the unknown floor in sight as further terms.
class HorizonChooser final : public PlaceChooser {
 public:
  explicit HorizonChooser(const ExploreParams& params) : params_(params) {}

  [[nodiscard]] PlaceChoice choose(const PlaceInput& input) override;
  [[nodiscard]] bool wants_wall_ends() const override { return true; }
  [[nodiscard]] bool changes_its_mind() const override { return true; }

 private:
  using Beam = std::vector<HorizonSequence>;

  /// All that one decision computes once.
  struct Outlook {
    const PlaceInput& input;
    SightScene scene;
    Belief belief;
    std::vector<HorizonView> views;
    double least_uncertainty = 0.0;
    std::vector<Point2> places;  ///< of views
    CoarsePaths paths;
    std::vector<std::vector<double>> path_m;  ///< from view to view, where needed
  };

  [[nodiscard]] Outlook look_out(const PlaceInput& input) const;
  void rate(HorizonSequence& sequence, const Outlook& outlook) const;
  void keep_best(Beam& beam, std::size_t count, std::optional<std::size_t> always) const;
  [[nodiscard]] Beam first_drives(const Outlook& outlook, std::optional<std::size_t> present) const;
  [[nodiscard]] std::optional<Beam> one_drive_more(const Beam& beam, Outlook& outlook) const;
  [[nodiscard]] ExploreDecision publish(const Outlook& outlook, const Beam& tried, const HorizonSequence& best) const;

  ExploreParams params_;
};

HorizonChooser::Outlook HorizonChooser::look_out(const PlaceInput& input) const {
  const OneStepParams& one_step = params_.one_step;
  Outlook outlook{input,
                  forecast_scene(input, one_step),
                  forecast_belief(input.robot, one_step),
                  {},
                  0.0,
                  {},
                  CoarsePaths(input.floor.reachable),
                  {}};
  outlook.views = horizon_views(input, outlook.scene, params_);
  outlook.least_uncertainty = least_uncertainty(outlook.belief, one_step.sensor);
  outlook.places.reserve(outlook.views.size());
  for (const HorizonView& view : outlook.views) {
    outlook.places.push_back(view.opening.map_T_view.translation());
  }
  outlook.path_m.resize(outlook.views.size());
  return outlook;
}

void HorizonChooser::rate(HorizonSequence& sequence, const Outlook& outlook) const {
  Growth growth;
  for (const ExpectedEnd& end : sequence.ends) {
    growth.extension_m += end.extension_m;
    growth.new_ends += end.becomes_real;
  }
  sequence.terms = combine(outlook.least_uncertainty, sequence.uncertainty, growth, outlook.scene, params_.one_step);
  sequence.score = sequence.terms.score + params_.viewpoints.weight_floor * std::log10(sequence.floor_m2);
}

/// Best first. `always` is kept with any score: it begins with the present drive of the robot.
void HorizonChooser::keep_best(Beam& beam, std::size_t count, std::optional<std::size_t> always) const {
  std::stable_sort(beam.begin(), beam.end(),
                   [](const HorizonSequence& a, const HorizonSequence& b) { return a.score > b.score; });
  if (beam.size() <= count) {
    return;
  }
  const auto cut = beam.begin() + static_cast<std::ptrdiff_t>(count);
  const auto present =
      std::find_if(cut, beam.end(), [&](const HorizonSequence& s) { return always && s.stops.front() == *always; });
  if (present != beam.end()) {
    *cut = *present;
    beam.erase(cut + 1, beam.end());
  } else {
    beam.erase(cut, beam.end());
  }
}

HorizonChooser::Beam HorizonChooser::first_drives(const Outlook& outlook, std::optional<std::size_t> present) const {
  const double now = outlook.belief.joint({}).uncertainty();
  Beam beam;
  beam.reserve(outlook.views.size());
  for (std::size_t k = 0; k < outlook.views.size(); ++k) {
    HorizonSequence first;
    first.uncertainty = now;
    beam.push_back(extended(first, outlook.views, k, outlook.views[k].path_m, params_.viewpoints.weight_path));
    rate(beam.back(), outlook);
  }
  // Covariances along a path are dear: for the promising ones only.
  keep_best(beam, static_cast<std::size_t>(params_.viewpoints.beam), present);
  for (HorizonSequence& first : beam) {
    first.uncertainty = forecast_leg(outlook.input, outlook.views[first.stops.front()].opening, outlook.scene,
                                     outlook.belief, params_.one_step)
                            .uncertainty;
    rate(first, outlook);
  }
  keep_best(beam, beam.size(), present);
  return beam;
}

/// Sequences after which nothing is left stay as they are; nothing when that is all of them.
std::optional<HorizonChooser::Beam> HorizonChooser::one_drive_more(const Beam& beam, Outlook& outlook) const {
  Beam longer;
  bool any = false;
  for (const HorizonSequence& sequence : beam) {
    const std::size_t last = sequence.stops.back();
    std::vector<double>& path_m = outlook.path_m[last];
    if (path_m.empty()) {
      path_m = outlook.paths.lengths_m(outlook.places[last], outlook.places);
    }
    bool goes_on = false;
    for (std::size_t k = 0; k < outlook.views.size(); ++k) {
      if (!sequence.settles(k) && path_m[k] != CoarsePaths::kNoPath) {
        longer.push_back(extended(sequence, outlook.views, k, path_m[k], params_.viewpoints.weight_path));
        rate(longer.back(), outlook);
        goes_on = true;
      }
    }
    if (!goes_on) {
      longer.push_back(sequence);
    }
    any = any || goes_on;
  }
  return any ? std::optional(std::move(longer)) : std::nullopt;
}

PlaceChoice HorizonChooser::choose(const PlaceInput& input) {
  Outlook outlook = look_out(input);
  std::optional<std::size_t> present;
  for (std::size_t k = 0; input.goal != nullptr && k < outlook.views.size(); ++k) {
    present = outlook.views[k].opening.id == input.goal->id ? std::optional(k) : present;
  }
  const Beam first = first_drives(outlook, present);
  Beam beam = first;
  for (int drive = 1; drive < params_.viewpoints.horizon; ++drive) {
    std::optional<Beam> longer = one_drive_more(beam, outlook);
    if (!longer) {
      break;
    }
    keep_best(*longer, static_cast<std::size_t>(params_.viewpoints.beam), present);
    beam = std::move(*longer);
  }
  const HorizonSequence* best = &beam.front();
  for (const HorizonSequence& sequence : beam) {
    if (present && sequence.stops.front() == *present &&
        sequence.score > best->score - params_.viewpoints.hysteresis_lg) {
      best = &sequence;
      break;
    }
  }
  PlaceChoice choice;
  choice.opening = outlook.views[best->stops.front()].opening;
  choice.decision = publish(outlook, first, *best);
  return choice;
}

ExploreDecision HorizonChooser::publish(const Outlook& outlook, const Beam& tried, const HorizonSequence& best) const {
  ExploreDecision decision;
  decision.rule = "horizon";
  for (std::size_t k = 0; k < outlook.views.size() && k < kMaxDecisionCandidates; ++k) {
    const HorizonView& view = outlook.views[k];
    DecisionCandidate candidate = candidate_of(view.opening, 0.0);
    const auto first =
        std::find_if(tried.begin(), tried.end(), [&](const HorizonSequence& s) { return s.stops.front() == k; });
    if (first != tried.end()) {
      candidate.lg_j1 = first->terms.lg_j1;
      candidate.lg_j21 = first->terms.lg_j21;
      candidate.lg_j22 = first->terms.lg_j22;
      candidate.score = k == best.stops.front() ? best.score : first->score;
    } else {
      candidate.refused = "not among the most promising first drives";
    }
    decision.candidates.push_back(std::move(candidate));
  }
  decision.chosen = static_cast<std::uint32_t>(best.stops.front());
  decision.why = "best of " + std::to_string(best.stops.size()) + " drives of " + text(best.path_m) + " m to " +
                 describe(outlook.views[best.stops.front()].opening);
  return decision;
}

}  // namespace

std::unique_ptr<PlaceChooser> make_horizon_chooser(const ExploreParams& params) {
  return std::make_unique<HorizonChooser>(params);
}

}  // namespace seeker::explore
