/// \file
/// R2 of spec S7: consistency of the line filter in a simulated office.
#pragma once

#include "server/lab/consistency/filter_consistency.hpp"
#include "server/lab/experiments/check.hpp"
#include "server/lab/experiments/reproduce_params.hpp"

namespace seeker::lab {

/// Writes r2.csv, r2-double.csv (twice the odometry noise), r2-local-maps.csv (across joins), r2-uneven.csv (wheels
/// without calibration, across joins), r2-nees.png, and a line for each case to the report.
[[nodiscard]] Status reproduce_consistency(const ReproduceParams& params, Report& report);

/// The tour of R2 through the world `office-no-target`: corridor, three rooms and back.
[[nodiscard]] std::vector<Point2> office_tour();
/// Makes the SPmap alone, with the true parameters of the robot's sensors.
[[nodiscard]] MakeTracker sp_tracker();
/// Makes line SLAM with the same parameters: a new local map every 10 m and no loop closures, so that the covariance
/// passes through the joins.
[[nodiscard]] MakeTracker local_maps_tracker();
/// Makes the same with estimation of the systematic errors of the wheels.
[[nodiscard]] MakeTracker learning_tracker();

}  // namespace seeker::lab
