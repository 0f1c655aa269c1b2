/// \file
/// Rotation-invariant signature of a place: few numbers by which similar places are found without comparing all pairs.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "server/slam/map_agreement.hpp"

namespace seeker::fleet {

/// Signature without a unit; its Euclidean distance is small for similar places.
inline constexpr std::size_t kSignatureSize = 16;
using ScanSignature = std::array<float, kSignatureSize>;

struct SignatureParams {
  double spacing_m = 1.0;  ///< path length between signatures
  double range_m = 8.0;    ///< range of the surroundings that are described
  int bearings = 72;       ///< number of directions in which the distance to the nearest wall is measured
};

/// The signature of the walls around `p`, from all given points: amplitudes of the Fourier series of the distance to
/// the nearest wall over the bearing, which are invariant under rotation, and its mean.
[[nodiscard]] ScanSignature signature_at(const Point2& p, const std::vector<slam::SeenPoints>& seen,
                                         const SignatureParams& params = {});

/// Signatures with a value each, searched by similarity: kd-tree, n log n to build, log n per query.
class SignatureIndex {
 public:
  SignatureIndex();
  explicit SignatureIndex(std::vector<std::pair<ScanSignature, std::size_t>> entries);
  SignatureIndex(SignatureIndex&& other) noexcept;
  SignatureIndex& operator=(SignatureIndex&& other) noexcept;
  ~SignatureIndex();

  struct Found {
    std::size_t value = 0;
    double distance = 0.0;
  };
  /// The nearest entries, nearest first.
  [[nodiscard]] std::vector<Found> nearest(const ScanSignature& signature, std::size_t at_most) const;
  [[nodiscard]] std::size_t size() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace seeker::fleet
