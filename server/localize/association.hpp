/// \file
/// Which feature of a sighting is which landmark (spec S2.5), and which of the rest may become one (S2.6).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "server/localize/landmark_database.hpp"

namespace seeker::localize {

/// A feature taken for a landmark.
struct Pairing {
  std::size_t point = 0;     ///< index of the SeenPoint
  std::size_t landmark = 0;  ///< index in the database
  double distance = 0.0;     ///< of descriptors, of unit length

  friend bool operator==(const Pairing&, const Pairing&) = default;
};

struct AssociationParams {
  vision::Metric metric = vision::Metric::kL2;
  double max_distance = 0.5;  ///< d_a of descriptors of unit length: 2.5 in the paper, by L1
  /// Spec S2.5 as printed: the most alike of the whole database, both ways, wherever it lies. Else only landmarks whose
  /// place agrees are asked.
  bool anywhere = false;
  double gate_chi2 = 11.345;   ///< of the places' difference, 3 degrees of freedom, 99 %
  double max_offset_m = 1.5;   ///< and never farther than this
  double min_offset_m = 0.05;  ///< and always as near as this, whatever the covariances say

  friend bool operator==(const AssociationParams&, const AssociationParams&) = default;
};

/// Spec S2.6.
struct SparsityParams {
  bool on = true;
  double inner_radius_m = 0.05;  ///< R_A: nothing new nearer than this to a landmark; 0.10 with the paper
  double outer_radius_m = 0.2;   ///< R_B: up to here only what looks different; 0.50 with the paper
  double min_distance = 0.7;     ///< d_f0 of descriptors: 2.5 in the paper, by L1
  /// Of what stands too close together the landmark that was seen most often stays, chosen once all are known. Else, as
  /// printed, the one that was seen first, however seldom it is seen again.
  bool best_first = true;

  friend bool operator==(const SparsityParams&, const SparsityParams&) = default;
};

/// Distance of descriptors of unit length, that of the most alike of a landmark's views.
[[nodiscard]] double landmark_distance(const Landmark& landmark, const vision::Descriptor& descriptor,
                                       vision::Metric metric);

/// All descriptors of a database as vision::nearest_two() takes them. A layer holds at most one descriptor of each
/// landmark, so that the two most alike of a layer are two landmarks.
struct DescriptorTable {
  struct Layer {
    std::vector<vision::Descriptor> rows;
    std::vector<std::size_t> owners;  ///< index of each row's landmark
  };
  std::vector<Layer> layers;

  DescriptorTable() = default;
  explicit DescriptorTable(const LandmarkDatabase& database);
};

/// A landmark that looks like a feature.
struct AlikeLandmark {
  std::size_t landmark = 0;  ///< index in the database
  double distance = 0.0;     ///< of the view that is most alike
  const vision::Descriptor* view = nullptr;
};

/// For every query the most alike landmarks, most alike first, each once: the two best of every layer. Points into
/// the table.
[[nodiscard]] std::vector<std::vector<AlikeLandmark>> alike_landmarks(const DescriptorTable& known,
                                                                      std::span<const vision::Descriptor> queries,
                                                                      vision::Metric metric);

/// Spec S2.5 as printed, over all of `known`: the most alike both ways, within params.max_distance.
[[nodiscard]] std::vector<Pairing> associate_anywhere(const DescriptorTable& known,
                                                      std::span<const vision::StereoFeature> features,
                                                      std::span<const SeenPoint> points,
                                                      const AssociationParams& params);

/// One landmark a point and one point a landmark, each the other's most alike, by rising index of the point:
/// anywhere, or only where the places agree.
[[nodiscard]] std::vector<Pairing> associate(const LandmarkDatabase& database,
                                             std::span<const vision::StereoFeature> features,
                                             std::span<const SeenPoint> points, const AssociationParams& params);

/// Eqs (8)-(9) for a point that no landmark was paired with.
[[nodiscard]] bool may_insert(const LandmarkDatabase& database, const SeenPoint& point,
                              const vision::Descriptor& descriptor, const SparsityParams& params,
                              vision::Metric metric);
/// Eqs (8)-(9) for a database as it is: erases what stands too close to a landmark that was seen more often, or as
/// often and earlier. How many.
std::size_t thin_out(LandmarkDatabase& database, const SparsityParams& params, vision::Metric metric);

}  // namespace seeker::localize
