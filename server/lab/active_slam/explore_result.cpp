#include "server/lab/active_slam/explore_result.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "common/files/files.hpp"
#include "server/drivers/replay/words.hpp"
#include "server/lab/experiments/described_json.hpp"

namespace seeker::lab {
namespace {

/// The columns of the curves, in the order of the file.
constexpr std::array kCurves = {&ExploreSample::time_s,        &ExploreSample::error_m,    &ExploreSample::robot_trace,
                                &ExploreSample::feature_trace, &ExploreSample::full_trace, &ExploreSample::map_wall_m,
                                &ExploreSample::path_m,        &ExploreSample::floor_m2};
constexpr std::string_view kHeader = "time_s,error_m,robot_trace,feature_trace,full_trace,map_wall_m,path_m,floor_m2\n";

constexpr double kPerCent = 0.01;
/// Of a share that is a whole number of per cents but for rounding.
constexpr double kRounding = 1e-9;

std::size_t whole_per_cents(double share) {
  return static_cast<std::size_t>(std::max(0.0, share) / kPerCent + kRounding);
}

/// The shortest text that reads back as the same number.
std::string text_of(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

}  // namespace

void describe(config::Fields& f, ExploreResult& result) {
  f.field("schema", result.schema);
  f.field("world", result.world);
  f.field("strategy", result.strategy);
  f.field("seed", result.seed);
  f.field("settings", result.settings);
  f.field("outcome", result.outcome);
  f.field("cause", result.cause);
  f.field("unreachable", result.unreachable);
  f.field("robot_time_s", result.robot_time_s);
  f.field("wall_time_s", result.wall_time_s);
  f.field("path_length_m", result.path_length_m);
  f.field("along_wall_m", result.along_wall_m);
  f.field("mean_error_m", result.mean_error_m);
  f.field("max_error_m", result.max_error_m);
  f.field("final_error_m", result.final_error_m);
  f.field("mean_robot_trace", result.mean_robot_trace);
  f.field("final_robot_trace", result.final_robot_trace);
  f.field("mean_feature_trace", result.mean_feature_trace);
  f.field("final_feature_trace", result.final_feature_trace);
  f.field("final_full_trace", result.final_full_trace);
  f.field("reachable_wall_m", result.reachable_wall_m);
  f.field("mapped_wall_m", result.mapped_wall_m);
  f.field("wall_share", result.wall_share);
  f.field("share_path_m", result.share_path_m);
  f.field("false_wall_m", result.false_wall_m);
  f.field("map_wall_m", result.map_wall_m);
  f.field("floor_m2", result.floor_m2);
  f.field("aligned", result.aligned);
  f.field("segments", result.segments);
  f.field("map_epoch", result.map_epoch);
  f.field("decisions", result.decisions);
  f.field("decide_s", result.decide_s);
  f.field("contacts", result.contacts);
  f.field("min_clearance_m", result.min_clearance_m);
  f.field("events", result.events);
  f.field("event_hash", result.event_hash);
}

double ExploreResult::path_to_share_m(double share) const {
  const std::size_t per_cents = whole_per_cents(share);
  return per_cents < share_path_m.size() ? share_path_m[per_cents] : path_length_m;
}

void note_share(ExploreResult& result, double share, double path_m) {
  const std::size_t reached = whole_per_cents(share) + 1;
  if (reached > result.share_path_m.size()) {
    result.share_path_m.resize(reached, path_m);
  }
}

Status save(const std::filesystem::path& path, const ExploreResult& result) {
  return files::write_file(path, to_json(result));
}

std::string curves_csv(const std::vector<ExploreSample>& samples) {
  std::string text(kHeader);
  for (const ExploreSample& sample : samples) {
    for (std::size_t n = 0; n < kCurves.size(); ++n) {
      text += (n == 0 ? "" : ",") + text_of(sample.*kCurves[n]);
    }
    text += '\n';
  }
  return text;
}

Result<std::vector<ExploreSample>> parse_curves(std::string_view text) {
  if (!text.starts_with(kHeader)) {
    return fail(Errc::kParse, "the first line does not name the curves of an exploration");
  }
  text.remove_prefix(kHeader.size());
  std::vector<ExploreSample> samples;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    drivers::Words words(text.substr(0, end), drivers::Words::kCommaOrBlank);
    text.remove_prefix(std::min(end + 1, text.size()));
    ExploreSample sample;
    for (const auto curve : kCurves) {
      sample.*curve = words.number();
    }
    if (!words.good() || !words.at_end()) {
      return fail(Errc::kParse, "line " + std::to_string(samples.size() + 2) + " is not a sample of an exploration");
    }
    samples.push_back(sample);
  }
  return samples;
}

void add_curves(const std::vector<ExploreSample>& samples, ExploreResult& result) {
  if (samples.empty()) {
    return;
  }
  const auto count = static_cast<double>(samples.size());
  for (const ExploreSample& sample : samples) {
    result.mean_error_m += sample.error_m / count;
    result.max_error_m = std::max(result.max_error_m, sample.error_m);
    result.mean_robot_trace += sample.robot_trace / count;
    result.mean_feature_trace += sample.feature_trace / count;
  }
  result.final_error_m = samples.back().error_m;
  result.final_robot_trace = samples.back().robot_trace;
  result.final_feature_trace = samples.back().feature_trace;
  result.final_full_trace = samples.back().full_trace;
  result.floor_m2 = samples.back().floor_m2;
}

}  // namespace seeker::lab
