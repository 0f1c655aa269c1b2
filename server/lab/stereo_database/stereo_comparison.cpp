#include "server/lab/stereo_database/stereo_comparison.hpp"

#include <algorithm>
#include <functional>
#include <string>

#include "common/core/angle.hpp"
#include "server/lab/experiments/seeds.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/stereo_database/reproduce_stereo_database.hpp"

namespace seeker::lab {
namespace {

using Runs = std::vector<StereoResult>;

/// Whether runs meet a condition, with the figures that say so, without spaces.
struct Judged {
  bool met = false;
  std::string figures;
};

double mean_over(const Runs& runs, const std::function<double(const StereoResult&)>& value) {
  double sum = 0.0;
  for (const StereoResult& run : runs) {
    sum += value(run);
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, runs.size()));
}

double millimetres(const Runs& runs, const char* database) {
  return 1000.0 * mean_score(runs, database, &DatabaseScore::rms_m);
}

Judged table1(const Runs& runs) {
  const auto per_picture = [&](int StereoResult::*member) {
    return mean_over(runs, [&](const StereoResult& run) {
      return static_cast<double>(run.*member) / std::max(1, run.survey_pictures);
    });
  };
  const double before = per_picture(&StereoResult::survey_before);
  const double after = per_picture(&StereoResult::survey_after);
  return {after > 0.0 && after < before, fixed(before, 0) + ">" + fixed(after, 0)};
}

Judged table2(const Runs& runs) {
  const double all = mean_score(runs, "all", &DatabaseScore::landmarks);
  const double sparse = mean_score(runs, "sparse", &DatabaseScore::landmarks);
  const double salient = mean_score(runs, "salient", &DatabaseScore::landmarks);
  return {all > sparse && sparse > salient && salient > 0.0,
          fixed(all, 0) + ">" + fixed(sparse, 0) + ">" + fixed(salient, 0)};
}

/// As printed: the error with the salient landmarks is not above that with all of them by more than the limit.
Judged table3_error(const Runs& runs) {
  const double all = millimetres(runs, "all");
  const double salient = millimetres(runs, "salient");
  return {all > 0.0 && salient <= kR3ErrorRatio * all,
          fixed(all, 1) + "," + fixed(millimetres(runs, "sparse"), 1) + "," + fixed(salient, 1) + "mm"};
}

Judged table3_time(const Runs& runs) {
  const auto ms = [&](const char* database) { return mean_score(runs, database, &DatabaseScore::median_step_ms); };
  return {ms("salient") < ms("sparse") && ms("sparse") < ms("all"),
          fixed(ms("all"), 2) + "," + fixed(ms("sparse"), 2) + "," + fixed(ms("salient"), 2) + "ms"};
}

Judged plans(const Runs& runs) {
  constexpr double kInside = 0.95;
  const auto inside = [&](const char* database) { return mean_score(runs, database, &DatabaseScore::inside); };
  return {std::min({inside("all"), inside("sparse"), inside("salient")}) >= kInside,
          fixed(inside("all"), 3) + "," + fixed(inside("sparse"), 3) + "," + fixed(inside("salient"), 3)};
}

Judged fig7(const Runs& runs) {
  const auto count = [&](int StereoResult::*member) {
    return mean_over(runs, [&](const StereoResult& run) { return static_cast<double>(run.*member); });
  };
  const double added = count(&StereoResult::added_features);
  const double known = count(&StereoResult::known_features);
  const double thinned = count(&StereoResult::thinned_features);
  return {added > 0.0 && known > 0.0 && thinned > 0.0,
          "new" + fixed(added, 0) + ",associated" + fixed(known, 0) + ",thinned" + fixed(thinned, 0)};
}

Judged fig12(const Runs& runs) {
  constexpr int kFrames = 4;
  bool all_shown = !runs.empty();
  for (const StereoResult& run : runs) {
    all_shown = all_shown && run.frames_shown == kFrames;
  }
  const auto count = [&](int StereoResult::*member) {
    return mean_over(runs, [&](const StereoResult& run) { return static_cast<double>(run.*member); });
  };
  return {all_shown, "matched" + fixed(count(&StereoResult::frames_matched), 0) + ",unmatched" +
                         fixed(count(&StereoResult::frames_unmatched), 0)};
}

Judged fig13(const Runs& runs) {
  const auto mm = [&](double DatabaseScore::*member) { return 1000.0 * mean_score(runs, "salient", member); };
  const double rms_deg = rad_to_deg(mean_score(runs, "salient", &DatabaseScore::rms_rad));
  return {mm(&DatabaseScore::rms_m) <= 1000.0 * kS2Rms_m && rms_deg <= kS2Rms_deg,
          fixed(mm(&DatabaseScore::rms_x_m), 1) + "," + fixed(mm(&DatabaseScore::rms_y_m), 1) + "mm," +
              fixed(rms_deg, 3) + "deg"};
}

bool is_updated(const Runs& runs) {
  return !runs.empty() &&
         std::all_of(runs.begin(), runs.end(), [](const StereoResult& run) { return run.find("updated") != nullptr; });
}

Judged update_counts(const Runs& runs) {
  const auto mean = [&](int StereoResult::*member) {
    return mean_over(runs, [&](const StereoResult& run) { return static_cast<double>(run.*member); });
  };
  const bool adds_up = is_updated(runs) && std::all_of(runs.begin(), runs.end(), [](const StereoResult& run) {
                         return run.added > 0 && run.removed > 0 && run.after == run.before + run.added - run.removed;
                       });
  return {adds_up, fixed(mean(&StereoResult::before), 0) + "+" + fixed(mean(&StereoResult::added), 0) + "-" +
                       fixed(mean(&StereoResult::removed), 0) + "=" + fixed(mean(&StereoResult::after), 0)};
}

Judged update_error(const Runs& runs) {
  const double before = millimetres(runs, "salient");
  const double updated = millimetres(runs, "updated");
  return {is_updated(runs) && before > 0.0 && updated <= kR4ErrorRatio * before,
          fixed(before, 1) + "," + fixed(updated, 1) + "mm"};
}

struct Row {
  const char* id;
  const char* of;     ///< the table or figure, and what its values are
  const char* paper;  ///< the values that the paper states; "-": none that can be read
  Judged (*judge)(const Runs&);
};

constexpr Row kRows[] = {{"R3", "Table1,Fig1:matches_before>after", "-", &table1},
                         {"R3", "Table2:all>sparse>salient", "?>844>307", &table2},
                         {"R3", "Table3:error(all,sparse,salient)", "not_worse", &table3_error},
                         {"R3", "Table3:time(all,sparse,salient)", "falls", &table3_time},
                         {"R3", "Figs4,6,8:share_in_the_room", "-", &plans},
                         {"R3", "Fig7:features_of_four_views", "-", &fig7},
                         {"R3", "Fig12:features_of_four_frames", "-", &fig12},
                         {"R3", "Fig13:rms(x,y,angle)", "-", &fig13},
                         {"R4", "landmarks", "307+56-42=321", &update_counts},
                         {"R4", "error(before,updated)", "close", &update_error}};

}  // namespace

void compare_stereo(const std::vector<StereoResult>& printed, const std::vector<StereoResult>& ours, Report& report) {
  for (const Row& row : kRows) {
    if (row.id == std::string("R4") && !is_updated(printed) && is_updated(ours) &&
        std::all_of(printed.begin(), printed.end(), [](const StereoResult& run) { return run.before == 0; })) {
      continue;  // the smallest form
    }
    const Judged as_printed = row.judge(printed);
    const Judged as_ours = row.judge(ours);
    report.add({.id = row.id,
                .passed = as_printed.met && as_ours.met,
                .figures = {{"of", row.of},
                            {"paper", row.paper},
                            {"printed", as_printed.figures},
                            {"ours", as_ours.figures},
                            {"seeds", seeds_text(printed)}},
                .finding = as_ours.met});
  }
}

void report_bisection(const std::vector<BisectionResult>& bisections, Report& report) {
  if (bisections.empty()) {
    return;
  }
  const auto mean_mm = [&](std::size_t row) {
    double sum_m = 0.0;
    for (const BisectionResult& bisection : bisections) {
      sum_m += bisection.rows[row].salient_rms_m;
    }
    return 1000.0 * sum_m / static_cast<double>(bisections.size());
  };
  const std::vector<BisectionRow>& rows = bisections.front().rows;
  Check check{.id = "R3-BISECTION", .passed = false, .figures = {}};
  std::size_t best = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    check.figures.emplace_back(rows[i].name + "_mm", fixed(mean_mm(i), 1));
    if (i + 1 < rows.size() && mean_mm(i) < mean_mm(best)) {
      best = i;
    }
  }
  check.figures.emplace_back("most", best > 0 ? rows[best].name : "none");
  check.figures.emplace_back("seeds", seeds_text(bisections));
  check.passed = mean_mm(rows.size() - 1) < mean_mm(0);
  report.add(std::move(check));
}

}  // namespace seeker::lab
