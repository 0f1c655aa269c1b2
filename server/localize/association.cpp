#include "server/localize/association.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include <Eigen/Cholesky>

#include "server/vision/feature_match.hpp"

namespace seeker::localize {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Keeps of each landmark's suitors the most alike; pairs come in by rising index of the point.
std::vector<Pairing> one_each(const std::vector<Pairing>& forward) {
  std::unordered_map<std::size_t, std::size_t> best;
  for (std::size_t i = 0; i < forward.size(); ++i) {
    const auto [found, is_new] = best.emplace(forward[i].landmark, i);
    if (!is_new && forward[i].distance < forward[found->second].distance) {
      found->second = i;
    }
  }
  std::vector<Pairing> pairs;
  for (std::size_t i = 0; i < forward.size(); ++i) {
    if (best.at(forward[i].landmark) == i) {
      pairs.push_back(forward[i]);
    }
  }
  return pairs;
}

/// The most alike of the landmarks whose place agrees with the point's.
Pairing best_near(const LandmarkDatabase& database, const SeenPoint& point, const vision::Descriptor& descriptor,
                  const AssociationParams& params) {
  // A landmark is not much less certain than twice what sees it now: beyond that radius nothing is missed.
  const double reach_m = std::clamp(std::sqrt(3.0 * params.gate_chi2 * point.map.covariance.trace()),
                                    params.min_offset_m, params.max_offset_m);
  Pairing best{0, kNone, params.max_distance};
  database.for_near(point.map.p, reach_m, [&](std::size_t index) {
    const Landmark& landmark = database.at(index);
    const Point3 offset = point.map.p - landmark.p_map;
    const double chi2 = offset.dot((point.map.covariance + landmark.covariance()).ldlt().solve(offset));
    if (chi2 > params.gate_chi2 && offset.norm() > params.min_offset_m) {
      return;
    }
    const double distance = landmark_distance(landmark, descriptor, params.metric);
    if (distance < best.distance || (distance == best.distance && index < best.landmark)) {
      best.landmark = index;
      best.distance = distance;
    }
  });
  return best;
}

}  // namespace

double landmark_distance(const Landmark& landmark, const vision::Descriptor& descriptor, vision::Metric metric) {
  std::uint32_t least = vision::NearestTwo::kFar;
  for (const LandmarkView& view : landmark.views) {
    least = std::min(least, vision::descriptor_distance(view.descriptor, descriptor, metric));
  }
  return vision::unit_distance(least, metric);
}

DescriptorTable::DescriptorTable(const LandmarkDatabase& database, int bbf_leaves_in, vision::Metric metric)
    : bbf_leaves(bbf_leaves_in) {
  for (std::size_t i = 0; i < database.size(); ++i) {
    const std::vector<LandmarkView>& views = database.at(i).views;
    layers.resize(std::max(layers.size(), views.size()));
    for (std::size_t k = 0; k < views.size(); ++k) {
      layers[k].rows.push_back(views[k].descriptor);
      layers[k].owners.push_back(i);
    }
  }
  if (bbf_leaves > 0) {
    for (Layer& layer : layers) {
      layer.tree.emplace(layer.rows, metric, vision::BbfParams{.max_leaves = bbf_leaves});
    }
  }
}

std::vector<vision::NearestTwo> DescriptorTable::Layer::nearest_two(std::span<const vision::Descriptor> queries,
                                                                    vision::Metric metric) const {
  return tree ? tree->nearest_two(queries) : vision::nearest_two(queries, rows, metric);
}

std::vector<std::vector<AlikeLandmark>> alike_landmarks(const DescriptorTable& known,
                                                        std::span<const vision::Descriptor> queries,
                                                        vision::Metric metric) {
  std::vector<std::vector<AlikeLandmark>> alike(queries.size());
  for (const DescriptorTable::Layer& layer : known.layers) {
    const auto nearest = layer.nearest_two(queries, metric);
    const auto add = [&](std::size_t query, std::int32_t row, std::uint32_t byte_distance) {
      if (row >= 0) {
        const auto at = static_cast<std::size_t>(row);
        alike[query].push_back({layer.owners[at], vision::unit_distance(byte_distance, metric), &layer.rows[at]});
      }
    };
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      add(i, nearest[i].best, nearest[i].best_distance);
      add(i, nearest[i].second, nearest[i].second_distance);
    }
  }
  for (std::vector<AlikeLandmark>& one : alike) {
    std::stable_sort(one.begin(), one.end(), [](const auto& a, const auto& b) { return a.distance < b.distance; });
    std::vector<AlikeLandmark> once;
    for (const AlikeLandmark& landmark : one) {
      const bool known_already = std::any_of(
          once.begin(), once.end(), [&](const AlikeLandmark& other) { return other.landmark == landmark.landmark; });
      if (!known_already) {
        once.push_back(landmark);
      }
    }
    one = std::move(once);
  }
  return alike;
}

std::vector<Pairing> associate_anywhere(const DescriptorTable& known, std::span<const vision::StereoFeature> features,
                                        std::span<const SeenPoint> points, const AssociationParams& params) {
  std::vector<vision::Descriptor> queries;
  queries.reserve(points.size());
  for (const SeenPoint& point : points) {
    queries.push_back(features[point.feature].descriptor);
  }
  const auto alike = alike_landmarks(known, queries, params.metric);
  std::vector<Pairing> forward;
  std::vector<vision::Descriptor> chosen;
  for (std::size_t i = 0; i < alike.size(); ++i) {
    if (!alike[i].empty() && alike[i].front().distance <= params.max_distance) {
      forward.push_back({i, alike[i].front().landmark, alike[i].front().distance});
      chosen.push_back(*alike[i].front().view);
    }
  }
  // Backward: the feature most alike to the chosen descriptor must be the one that chose it.
  const auto back = vision::nearest_two(chosen, queries, params.metric, known.bbf_leaves);
  std::vector<Pairing> mutual;
  for (std::size_t k = 0; k < forward.size(); ++k) {
    if (back[k].best == static_cast<std::int32_t>(forward[k].point)) {
      mutual.push_back(forward[k]);
    }
  }
  return one_each(mutual);
}

std::vector<Pairing> associate(const LandmarkDatabase& database, std::span<const vision::StereoFeature> features,
                               std::span<const SeenPoint> points, const AssociationParams& params) {
  if (database.empty() || points.empty()) {
    return {};
  }
  if (params.anywhere) {
    return associate_anywhere(DescriptorTable(database, params.bbf_leaves, params.metric), features, points, params);
  }
  std::vector<Pairing> forward;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Pairing best = best_near(database, points[i], features[points[i].feature].descriptor, params);
    if (best.landmark != kNone) {
      best.point = i;
      forward.push_back(best);
    }
  }
  return one_each(forward);
}

namespace {

/// Eqs (8)-(9) for a place within the outer radius of one landmark.
bool stands_apart(const Landmark& landmark, const Point3& p_map, const vision::Descriptor& descriptor,
                  const SparsityParams& params, vision::Metric metric) {
  return (landmark.p_map - p_map).norm() > params.inner_radius_m &&
         landmark_distance(landmark, descriptor, metric) > params.min_distance;
}

}  // namespace

bool may_insert(const LandmarkDatabase& database, const SeenPoint& point, const vision::Descriptor& descriptor,
                const SparsityParams& params, vision::Metric metric) {
  if (!params.on) {
    return true;
  }
  bool allowed = true;
  database.for_near(point.map.p, params.outer_radius_m, [&](std::size_t index) {
    allowed = allowed && stands_apart(database.at(index), point.map.p, descriptor, params, metric);
  });
  return allowed;
}

std::size_t thin_out(LandmarkDatabase& database, const SparsityParams& params, vision::Metric metric) {
  if (!params.on) {
    return 0;
  }
  std::vector<std::size_t> order(database.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return database.at(a).seen > database.at(b).seen; });
  std::vector<bool> stays(database.size(), false);
  std::unordered_set<LandmarkId> dropped;
  for (const std::size_t candidate : order) {
    const Landmark& landmark = database.at(candidate);
    bool apart = true;
    database.for_near(landmark.p_map, params.outer_radius_m, [&](std::size_t index) {
      apart = apart && (!stays[index] || stands_apart(database.at(index), landmark.p_map,
                                                      landmark.views.front().descriptor, params, metric));
    });
    stays[candidate] = apart;
    if (!apart) {
      dropped.insert(landmark.id);
    }
  }
  return database.erase_if([&](const Landmark& landmark) { return dropped.contains(landmark.id); });
}

}  // namespace seeker::localize
