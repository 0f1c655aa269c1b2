#include "server/lab/map_merging/other_buildings.hpp"

#include <algorithm>
#include <utility>

#include "server/fleet/map_merger.hpp"

namespace seeker::lab {
namespace {

constexpr double kMapPeriod_s = 5.0;

std::string name_of(const BuildingMap& map) { return map.world + " seed " + std::to_string(map.seed); }

OtherBuildings compare(const BuildingMap& a, const BuildingMap& b, fleet::PreparedMap& prepared_a,
                       fleet::PreparedMap& prepared_b) {
  const fleet::MergeAnswer answer = fleet::MapMerger().merge(prepared_a, prepared_b);
  OtherBuildings pair;
  pair.a = name_of(a);
  pair.b = name_of(b);
  pair.verdict = to_string(answer.verdict);
  if (!answer.hypotheses.empty()) {
    const fleet::MergeHypothesis& best = answer.hypotheses.front();
    pair.shared_wall_m = best.shared_wall_m;
    pair.contradiction = best.contradiction;
    pair.deformation_ratio = best.deformation.ratio();
  }
  return pair;
}

}  // namespace

Result<std::vector<BuildingMap>> map_buildings(const std::vector<ExploreSpec>& specs) {
  std::vector<BuildingMap> maps;
  for (const ExploreSpec& spec : specs) {
    BuildingMap made;
    made.seed = spec.seed;
    double next_s = 0.0;
    const auto keep = [&made, &next_s](const app::RobotLoop& loop, const sim::Simulation&) {
      const double now_s = to_seconds(loop.now());
      if (now_s < next_s) {
        return;
      }
      next_s = now_s + kMapPeriod_s;
      if (Result<LineMap> map = loop.robot_map().map()) {
        made.map = *std::move(map);
      }
    };
    const Result<ExploreRecord> record = run_explore(spec, keep);
    if (!record) {
      return tl::unexpected<Error>(record.error());
    }
    made.world = record->result.world;
    maps.push_back(std::move(made));
  }
  return maps;
}

Result<std::vector<OtherBuildings>> compare_buildings(const std::vector<BuildingMap>& maps) {
  std::vector<fleet::PreparedMap> prepared(maps.size());
  for (std::size_t k = 0; k < maps.size(); ++k) {
    if (Status taken = prepared[k].update(maps[k].map); !taken) {
      return fail_with_context(name_of(maps[k]), taken.error());
    }
  }
  std::vector<OtherBuildings> pairs;
  for (std::size_t a = 0; a < maps.size(); ++a) {
    for (std::size_t b = a + 1; b < maps.size(); ++b) {
      if (maps[a].world != maps[b].world) {
        pairs.push_back(compare(maps[a], maps[b], prepared[a], prepared[b]));
      }
    }
  }
  return pairs;
}

Check check_other_buildings(const std::vector<OtherBuildings>& pairs) {
  const auto merged = std::count_if(pairs.begin(), pairs.end(), [](const OtherBuildings& pair) {
    return pair.verdict == to_string(fleet::MergeVerdict::kMerged);
  });
  const auto most = std::max_element(pairs.begin(), pairs.end(), [](const OtherBuildings& p, const OtherBuildings& q) {
    return p.shared_wall_m < q.shared_wall_m;
  });
  return {.id = "S4-OTHERS",
          .passed = !pairs.empty() && merged == 0,
          .figures = {{"pairs", std::to_string(pairs.size())},
                      {"merged", std::to_string(merged)},
                      {"shared_wall_max_m", fixed(most == pairs.end() ? 0.0 : most->shared_wall_m, 1)}}};
}

Table other_buildings_table(const std::vector<OtherBuildings>& pairs) {
  Table table({"a", "b", "verdict", "shared_wall_m", "contradiction", "deformation_ratio"});
  for (const OtherBuildings& pair : pairs) {
    table.add({pair.a, pair.b, pair.verdict, fixed(pair.shared_wall_m, 1), fixed(pair.contradiction, 3),
               fixed(pair.deformation_ratio, 2)});
  }
  return table;
}

}  // namespace seeker::lab
