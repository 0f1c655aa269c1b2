/// \file
/// Parameters of the key point detector that all who look for key points share.
#pragma once

#include "common/core/result.hpp"
#include "server/vision/descriptor.hpp"

namespace seeker::vision {

/// Key points of one picture.
struct DetectorParams {
  DescriptorKind kind = DescriptorKind::kRootSift;
  int wanted = 500;                  ///< the contrast threshold is lowered until a picture promises as many
  int at_most = 0;                   ///< kept, spread over the picture; 0: as many as wanted
  double contrast_threshold = 0.04;  ///< halved up to `contrast_halvings` times for poor pictures, raised for rich ones
  int contrast_halvings = 2;
  double edge_threshold = 10.0;
  int grid_columns = 8;  ///< the strongest of each cell are kept first
  int grid_rows = 6;
  bool half_resolution = false;  ///< detect in a picture of half the size; places are still told in full pixels

  friend bool operator==(const DetectorParams&, const DetectorParams&) = default;
};

/// kInvalidArgument with the field's name.
[[nodiscard]] Status validate(const DetectorParams& params);

}  // namespace seeker::vision
