/// \file
/// What a place looks like whatever way the robot faced: few numbers, so that like places are found without comparing
/// all with all.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "server/slam/map_agreement.hpp"

namespace seeker::fleet {

/// Unit-less; near to each other (Euclidean) where the places are alike.
inline constexpr std::size_t kSignatureSize = 16;
using ScanSignature = std::array<float, kSignatureSize>;

struct SignatureParams {
  double spacing_m = 1.0;  ///< a signature every so much way
  double range_m = 8.0;    ///< surroundings that count
  int bearings = 72;       ///< directions in which the distance to the nearest wall is taken
};

/// Of the walls around `p`, put together from all points given: amplitudes of the Fourier series of the distance to
/// the nearest wall over the bearing, which a turn does not change, and its mean.
[[nodiscard]] ScanSignature signature_at(const Point2& p, const std::vector<slam::SeenPoints>& seen,
                                         const SignatureParams& params = {});

/// Signatures with a value each, found by likeness: kd-tree, n log n to build, log n a question.
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
