#include "server/explore/place_strategy.hpp"

namespace seeker::explore {
namespace {

/// Nearest frontier (Yamauchi 1997) by path cost; with the ends of walls where they are requested.
class FrontierChooser final : public PlaceChooser {
 public:
  explicit FrontierChooser(bool wall_ends) : wall_ends_(wall_ends) {}

  [[nodiscard]] PlaceChoice choose(const PlaceInput& input) override {
    PlaceChoice choice;
    choice.opening = input.openings.front();
    choice.decision.rule = "frontier";
    choice.decision.chosen = 0;
    choice.decision.why = wall_ends_ ? "the nearest opening" : "the nearest border of unknown floor";
    for (const Opening& opening : input.openings) {
      if (choice.decision.candidates.size() == kMaxDecisionCandidates) {
        break;
      }
      choice.decision.candidates.push_back(candidate_of(opening, -opening.cost));
    }
    return choice;
  }
  [[nodiscard]] bool wants_wall_ends() const override { return wall_ends_; }
  [[nodiscard]] bool changes_its_mind() const override { return false; }

 private:
  bool wall_ends_;
};

}  // namespace

std::unique_ptr<PlaceChooser> make_frontier_chooser(const ExploreParams& /*params*/) {
  return std::make_unique<FrontierChooser>(false);
}

std::unique_ptr<PlaceChooser> make_opening_chooser() { return std::make_unique<FrontierChooser>(true); }

}  // namespace seeker::explore
