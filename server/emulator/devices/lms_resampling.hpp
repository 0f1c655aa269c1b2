/// \file
/// From the scan of the simulated scanner to the beams of a variant of the LMS200.
#pragma once

#include <vector>

#include "common/core/scan.hpp"
#include "server/protocols/lms200/measuring.hpp"

namespace seeker::emulator {

/// Ranges of the variant's beams in metres, kNoReturn where the scan has none or does not reach. Where the scan has the
/// beam, its range; between two beams of one surface a linear mean of both, otherwise the nearer beam's.
[[nodiscard]] std::vector<float> resampled(const LaserScan& scan, const lms200::Variant& variant);

}  // namespace seeker::emulator
