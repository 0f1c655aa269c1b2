#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"
#include "server/lab/experiments/seeds.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/stereo_database/reproduce_stereo_database.hpp"

namespace seeker::lab {
namespace {

/// Means over the seeds of one database; all zero where no run has it.
struct Mean {
  double landmarks = 0.0;
  double rms_m = 0.0;
  double rms_rad = 0.0;
  double nees = 0.0;
  double compared = 0.0;
  double step_ms = 0.0;
  int unnoticed = 0;
  int runs = 0;
};

Mean mean_of(const std::vector<StereoResult>& runs, std::string_view name) {
  Mean mean{.landmarks = mean_score(runs, name, &DatabaseScore::landmarks),
            .rms_m = mean_score(runs, name, &DatabaseScore::rms_m),
            .rms_rad = mean_score(runs, name, &DatabaseScore::rms_rad),
            .nees = mean_score(runs, name, &DatabaseScore::mean_nees),
            .compared = mean_score(runs, name, &DatabaseScore::mean_compared),
            .step_ms = mean_score(runs, name, &DatabaseScore::median_step_ms)};
  for (const StereoResult& run : runs) {
    const DatabaseScore* score = run.find(name);
    mean.unnoticed += score != nullptr ? score->unnoticed : 0;
    mean.runs += score != nullptr ? 1 : 0;
  }
  return mean;
}

using Figures = std::vector<std::pair<std::string, std::string>>;

Figures figures_of(const std::vector<StereoResult>& runs) {
  return {{"mode", runs.front().mode}, {"seeds", seeds_text(runs)}};
}

void add(Report& report, std::string id, bool passed, const std::vector<StereoResult>& runs, Figures figures) {
  const Figures head = figures_of(runs);
  figures.insert(figures.begin(), head.begin(), head.end());
  report.add({std::move(id), passed, std::move(figures)});
}

/// Errors are compared in the plane; a ratio of directions of some hundredths of a degree says nothing. That a smaller
/// database costs less is judged by what association compares, which no other load of the machine changes.
void check_r3(const std::vector<StereoResult>& runs, Report& report) {
  const Mean all = mean_of(runs, "all");
  const Mean sparse = mean_of(runs, "sparse");
  const Mean salient = mean_of(runs, "salient");
  const double ratio = all.rms_m > 0.0 ? salient.rms_m / all.rms_m : 0.0;
  add(report, "R3",
      all.runs > 0 && salient.landmarks < sparse.landmarks && sparse.landmarks < all.landmarks &&
          salient.compared < sparse.compared && sparse.compared < all.compared && ratio <= kR3ErrorRatio,
      runs,
      {{"landmarks", fixed(all.landmarks, 0) + ">" + fixed(sparse.landmarks, 0) + ">" + fixed(salient.landmarks, 0)},
       {"compared", fixed(all.compared, 0) + ">" + fixed(sparse.compared, 0) + ">" + fixed(salient.compared, 0)},
       {"step_ms", fixed(all.step_ms, 2) + ">" + fixed(sparse.step_ms, 2) + ">" + fixed(salient.step_ms, 2)},
       {"error_ratio", fixed(ratio, 3)},
       {"limit", fixed(kR3ErrorRatio, 1)}});
}

void check_r4(const std::vector<StereoResult>& runs, Report& report) {
  const Mean before = mean_of(runs, "salient");
  const Mean outdated = mean_of(runs, "outdated");
  const Mean updated = mean_of(runs, "updated");
  const double ratio = before.rms_m > 0.0 ? updated.rms_m / before.rms_m : 0.0;
  int added = 0;
  int removed = 0;
  bool counted = updated.runs == static_cast<int>(runs.size());
  for (const StereoResult& run : runs) {
    added += run.added;
    removed += run.removed;
    counted = counted && run.added > 0 && run.removed > 0 && run.after == run.before + run.added - run.removed;
  }
  add(report, "R4", counted && ratio <= kR4ErrorRatio, runs,
      {{"before", fixed(before.landmarks, 0)},
       {"added", std::to_string(added)},
       {"removed", std::to_string(removed)},
       {"after", fixed(updated.landmarks, 0)},
       {"rms_before_mm", fixed(1000.0 * before.rms_m, 1)},
       {"rms_outdated_mm", fixed(1000.0 * outdated.rms_m, 1)},
       {"rms_updated_mm", fixed(1000.0 * updated.rms_m, 1)},
       {"error_ratio", fixed(ratio, 3)},
       {"limit", fixed(kR4ErrorRatio, 1)}});
}

void check_accuracy(const std::vector<StereoResult>& runs, Report& report) {
  for (const char* name : {"salient", "updated"}) {
    const Mean mean = mean_of(runs, name);
    double worst_m = 0.0;
    double worst_rad = 0.0;
    for (const StereoResult& run : runs) {
      if (const DatabaseScore* score = run.find(name)) {
        worst_m = std::max(worst_m, score->rms_m);
        worst_rad = std::max(worst_rad, score->rms_rad);
      }
    }
    add(report, "S2-RMS",
        mean.runs > 0 && worst_m <= kS2Rms_m && rad_to_deg(worst_rad) <= kS2Rms_deg && mean.nees <= kS2Nees &&
            mean.unnoticed == 0,
        runs,
        {{"database", name},
         {"worst_rms_mm", fixed(1000.0 * worst_m, 1)},
         {"limit_mm", fixed(1000.0 * kS2Rms_m, 0)},
         {"worst_rms_deg", fixed(rad_to_deg(worst_rad), 3)},
         {"mean_nees", fixed(mean.nees, 2)},
         {"nees_limit", fixed(kS2Nees, 0)},
         {"unnoticed", std::to_string(mean.unnoticed)}});
  }
}

std::string share_of(int part, int whole) { return std::to_string(part) + "/" + std::to_string(whole); }

/// Judges the robots that rotate on the spot; the places found by their first views are reported too.
void check_places(const std::vector<StereoResult>& runs, Report& report) {
  StereoResult sum;
  for (const StereoResult& run : runs) {
    sum.places += run.places;
    sum.places_found += run.places_found;
    sum.places_wrong += run.places_wrong;
    sum.at_once += run.at_once;
    sum.at_once_wrong += run.at_once_wrong;
    sum.looks += run.looks;
    sum.looks_refused += run.looks_refused;
    sum.looks_most = std::max(sum.looks_most, run.looks_most);
    sum.foreign += run.foreign;
    sum.foreign_found += run.foreign_found;
    sum.foreign_empty += run.foreign_empty;
  }
  add(report, "S2-PLACE",
      sum.places > 0 && sum.places_found - sum.places_wrong >= kS2PlaceShare * sum.places && sum.places_wrong == 0,
      runs,
      {{"found", share_of(sum.places_found, sum.places)},
       {"wrong", std::to_string(sum.places_wrong)},
       {"limit", fixed(kS2PlaceShare, 2)},
       {"looks_mean", fixed(static_cast<double>(sum.looks) / std::max(1, sum.places), 1)},
       {"looks_most", std::to_string(sum.looks_most)},
       {"looks_refused", share_of(sum.looks_refused, sum.looks)},
       {"first_view_found", share_of(sum.at_once, sum.places)},
       {"first_view_wrong", std::to_string(sum.at_once_wrong)}});
  add(report, "S2-FOREIGN", sum.foreign > 0 && sum.foreign_found == 0, runs,
      {{"found", share_of(sum.foreign_found, sum.foreign)}, {"without_features", std::to_string(sum.foreign_empty)}});
}

}  // namespace

void check_stereo(const std::vector<StereoResult>& runs, Report& report) {
  if (runs.empty()) {
    return;
  }
  check_r3(runs, report);
  check_r4(runs, report);
  check_accuracy(runs, report);
  check_places(runs, report);
}

}  // namespace seeker::lab
