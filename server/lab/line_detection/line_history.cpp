#include "server/lab/line_detection/line_history.hpp"

#include <algorithm>
#include <array>

#include "common/image/plot.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/line_detection/line_scene.hpp"
#include "server/lab/line_detection/reproduce_line_detection.hpp"

namespace seeker::lab {
namespace {

constexpr std::array kStartScales{1.0, 2.0};
constexpr double kToMillimetres = 1000.0;

/// How the packets of all seeds ended.
struct HistoryTally {
  int packets = 0;
  int adapted = 0;  ///< packets with more than one round
  int settled = 0;  ///< packets whose last round fits, or cannot shrink further
  std::size_t most_rounds = 0;
  double worst_first_mm = 0.0;
  double worst_last_mm = 0.0;
};

void add_packet(const lines::PacketHistory& packet, const lines::PaperParams& params, HistoryTally& tally) {
  const double last_m = packet.worst_error_m.back();
  const bool floor = packet.rounds.back().corner_m <= params.min_corner_m;
  const bool spent = static_cast<int>(packet.rounds.size()) > params.max_rounds;
  ++tally.packets;
  tally.adapted += packet.rounds.size() > 1 ? 1 : 0;
  tally.settled += last_m <= params.max_fit_error_m || floor || spent ? 1 : 0;
  tally.most_rounds = std::max(tally.most_rounds, packet.rounds.size());
  tally.worst_first_mm = std::max(tally.worst_first_mm, kToMillimetres * packet.worst_error_m.front());
  tally.worst_last_mm = std::max(tally.worst_last_mm, kToMillimetres * last_m);
}

/// The rounds of one packet as curves: gap and corner threshold relative to their start, and the fit error.
void add_curves(const lines::PacketHistory& packet, const std::string& name, image::Chart& chart) {
  image::Series corner{
      .name = name + ", corner threshold", .x = {}, .y = {}, .style = image::SeriesStyle::kLineAndPoints};
  image::Series error{.name = name + ", worst fit error", .x = {}, .y = {}, .style = image::SeriesStyle::kLine};
  error.line = image::LineStyle::kDashed;
  for (std::size_t k = 0; k < packet.rounds.size(); ++k) {
    corner.x.push_back(static_cast<double>(k));
    error.x.push_back(static_cast<double>(k));
    corner.y.push_back(kToMillimetres * packet.rounds[k].corner_m);
    error.y.push_back(kToMillimetres * packet.worst_error_m[k]);
  }
  corner.colour = error.colour = image::series_colour(chart.series.size() / 2);
  chart.series.push_back(std::move(corner));
  chart.series.push_back(std::move(error));
}

}  // namespace

ThresholdHistory check_history(const std::vector<std::uint64_t>& seeds, Report& report) {
  Table table({"start", "packet", "first_beam", "last_beam", "round", "gap_mm", "corner_mm", "worst_error_mm"});
  image::Chart chart;
  chart.title = "Threshold history of the packets that were adapted";
  chart.x_label = "round";
  chart.y_label = "mm";
  for (const double scale : kStartScales) {
    lines::PaperParams params = printed_line_params();
    params.start = {scale * params.start.gap_m, scale * params.start.corner_m};
    HistoryTally tally;
    for (const std::uint64_t seed : seeds) {
      Rng rng(seed);
      const std::vector<lines::PacketHistory> history = lines::PaperExtractor(params).extract(table1_scan(rng)).history;
      for (std::size_t p = 0; p < history.size(); ++p) {
        add_packet(history[p], params, tally);
        if (seed != seeds.front()) {
          continue;
        }
        for (std::size_t k = 0; k < history[p].rounds.size(); ++k) {
          table.add({"x" + fixed(scale, 0), std::to_string(p), std::to_string(history[p].first_beam),
                     std::to_string(history[p].last_beam), std::to_string(k),
                     fixed(kToMillimetres * history[p].rounds[k].gap_m, 1),
                     fixed(kToMillimetres * history[p].rounds[k].corner_m, 2),
                     fixed(kToMillimetres * history[p].worst_error_m[k], 2)});
        }
        if (history[p].rounds.size() > 1) {
          add_curves(history[p], "start x" + fixed(scale, 0) + ", packet " + std::to_string(p), chart);
        }
      }
    }
    report.add({.id = "R10",
                .passed = tally.settled == tally.packets,
                .figures = {{"thresholds_start", "x" + fixed(scale, 0)},
                            {"packets", std::to_string(tally.packets)},
                            {"adapted", std::to_string(tally.adapted)},
                            {"most_rounds", std::to_string(tally.most_rounds)},
                            {"worst_error_first_mm", fixed(tally.worst_first_mm, 2)},
                            {"worst_error_last_mm", fixed(tally.worst_last_mm, 2)}}});
  }
  return {table.csv(), image::draw_chart(chart)};
}

}  // namespace seeker::lab
