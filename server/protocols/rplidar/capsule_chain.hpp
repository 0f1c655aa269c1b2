/// \file
/// Capsules to samples: the angles of a capsule are known when the next one has come (protocols 3.4).
#pragma once

#include <array>
#include <optional>

#include "server/protocols/rplidar/express_capsule.hpp"

namespace seeker::rplidar {

/// Holds one capsule until its successor shows how far the scanner turned meanwhile.
class CapsuleChain {
 public:
  /// Adds the next capsule and returns the samples of the one before. Nothing: there is none, or it was not the one
  /// directly before. `after_gap` says that bytes between the two were lost or damaged.
  [[nodiscard]] std::optional<std::array<PolarSample, kCapsuleSamples>> add(const ExpressCapsule& capsule,
                                                                            bool after_gap);
  /// Forgets everything: another scan begins.
  void reset();

 private:
  [[nodiscard]] bool plausible(int advance_q6);

  std::optional<ExpressCapsule> held_;
  std::optional<double> usual_advance_q6_;  ///< from capsule to capsule, smoothed
};

}  // namespace seeker::rplidar
