/// \file
/// Data association of features with landmarks (spec S2.5), and selection of new landmarks (S2.6).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "server/localize/landmark_database.hpp"
#include "server/vision/bbf_tree.hpp"

namespace seeker::localize {

/// A feature associated with a landmark.
struct Pairing {
  std::size_t point = 0;     ///< index of the SeenPoint
  std::size_t landmark = 0;  ///< index in the database
  double distance = 0.0;     ///< distance of the descriptors of unit length

  friend bool operator==(const Pairing&, const Pairing&) = default;
};

struct AssociationParams {
  vision::Metric metric = vision::Metric::kL2;
  double max_distance = 0.5;  ///< d_a, largest distance of descriptors of unit length: 2.5 in the paper, by L1
  /// Spec S2.5 as printed: the mutually nearest descriptors of the whole database, at any position. Otherwise only
  /// landmarks whose position agrees are compared.
  bool anywhere = false;
  /// Number of leaves of a k-d tree that best-bin-first search of the whole database examines for each feature, 200 in
  /// the paper (spec S2.1); 0: all landmarks are compared.
  int bbf_leaves = 0;
  double gate_chi2 = 11.345;   ///< gate of the difference in position, 3 degrees of freedom, 99 %
  double max_offset_m = 1.5;   ///< upper limit of this difference
  double min_offset_m = 0.05;  ///< difference that is always accepted, for any covariances

  friend bool operator==(const AssociationParams&, const AssociationParams&) = default;
};

/// The sparsity rule of spec S2.6.
struct SparsityParams {
  bool on = true;
  double inner_radius_m = 0.05;  ///< R_A: no new landmark within this distance of another; 0.10 in the paper
  /// R_B: within this distance only landmarks with a different descriptor; 0.50 in the paper
  double outer_radius_m = 0.2;
  double min_distance = 0.7;  ///< d_f0, smallest distance of descriptors: 2.5 in the paper, by L1
  /// Of landmarks too close together the most frequently observed one is kept, chosen once all are known. Otherwise, as
  /// printed, the first observed one, however seldom it is observed again.
  bool best_first = true;

  friend bool operator==(const SparsityParams&, const SparsityParams&) = default;
};

/// Smallest distance between a descriptor of unit length and those of a landmark's views.
[[nodiscard]] double landmark_distance(const Landmark& landmark, const vision::Descriptor& descriptor,
                                       vision::Metric metric);

/// All descriptors of a database in the form that vision::nearest_two() takes. A layer holds at most one descriptor of
/// each landmark, so that the two nearest of a layer belong to two landmarks.
struct DescriptorTable {
  struct Layer {
    std::vector<vision::Descriptor> rows;
    std::vector<std::size_t> owners;      ///< index of each row's landmark
    std::optional<vision::BbfTree> tree;  ///< of the rows, where best-bin-first search is wanted

    [[nodiscard]] std::vector<vision::NearestTwo> nearest_two(std::span<const vision::Descriptor> queries,
                                                              vision::Metric metric) const;
  };
  std::vector<Layer> layers;
  int bbf_leaves = 0;

  DescriptorTable() = default;
  /// With `bbf_leaves` above 0 it is searched by best-bin-first search, by `metric` alone; else exactly, by any.
  explicit DescriptorTable(const LandmarkDatabase& database, int bbf_leaves = 0,
                           vision::Metric metric = vision::Metric::kL2);
};

/// A landmark with a descriptor similar to a feature's.
struct AlikeLandmark {
  std::size_t landmark = 0;  ///< index in the database
  double distance = 0.0;     ///< distance of the most similar view
  const vision::Descriptor* view = nullptr;
};

/// For every query the most similar landmarks, nearest first, each once: the two best of every layer. The results point
/// into the table.
[[nodiscard]] std::vector<std::vector<AlikeLandmark>> alike_landmarks(const DescriptorTable& known,
                                                                      std::span<const vision::Descriptor> queries,
                                                                      vision::Metric metric);

/// Associates by spec S2.5 as printed, over all of `known`: the mutually nearest within params.max_distance.
[[nodiscard]] std::vector<Pairing> associate_anywhere(const DescriptorTable& known,
                                                      std::span<const vision::StereoFeature> features,
                                                      std::span<const SeenPoint> points,
                                                      const AssociationParams& params);

/// Associates each point with at most one landmark and each landmark with at most one point, mutually nearest, in the
/// order of the points' indices: anywhere, or only where the positions agree.
[[nodiscard]] std::vector<Pairing> associate(const LandmarkDatabase& database,
                                             std::span<const vision::StereoFeature> features,
                                             std::span<const SeenPoint> points, const AssociationParams& params);

/// Whether a point that was not associated may become a landmark, by eqs (8)-(9).
[[nodiscard]] bool may_insert(const LandmarkDatabase& database, const SeenPoint& point,
                              const vision::Descriptor& descriptor, const SparsityParams& params,
                              vision::Metric metric);
/// Applies eqs (8)-(9) to an existing database: erases landmarks too close to one that was observed more often, or as
/// often and earlier. Returns the number of erased ones.
std::size_t thin_out(LandmarkDatabase& database, const SparsityParams& params, vision::Metric metric);

}  // namespace seeker::localize
