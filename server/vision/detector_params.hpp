/// \file
/// Parameters of the key point detector that is shared by all users of key points.
#pragma once

#include "common/core/result.hpp"
#include "server/vision/descriptor.hpp"

namespace seeker::vision {

/// Key points of one picture.
struct DetectorParams {
  DescriptorKind kind = DescriptorKind::kRootSift;
  int wanted = 500;  ///< the contrast threshold is lowered until a picture is expected to have so many key points
  int at_most = 0;   ///< number kept, spread over the picture; 0: as many as wanted
  /// Halved up to `contrast_halvings` times for poor pictures, raised for rich ones.
  double contrast_threshold = 0.04;
  int contrast_halvings = 2;
  double edge_threshold = 10.0;
  int grid_columns = 8;  ///< columns of the grid; the strongest key points of each cell are kept first
  int grid_rows = 6;
  bool half_resolution = false;  ///< detect in a picture of half the size; positions are still given in full pixels

  friend bool operator==(const DetectorParams&, const DetectorParams&) = default;
};

/// Fails with kInvalidArgument and the field's name.
[[nodiscard]] Status validate(const DetectorParams& params);

}  // namespace seeker::vision
