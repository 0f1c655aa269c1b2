/// \file
/// R2 of spec S7: consistency of the line filter in a simulated office.
#pragma once

#include "server/lab/consistency/filter_consistency.hpp"
#include "server/lab/experiments/check.hpp"
#include "server/lab/experiments/reproduce_params.hpp"

namespace seeker::lab {

/// r2.csv, r2-double.csv (twice the odometry noise), r2-local-maps.csv (across joins), r2-uneven.csv (wheels that
/// nobody has calibrated, across joins), r2-nees.png; a line per case to the report.
[[nodiscard]] Status reproduce_consistency(const ReproduceParams& params, Report& report);

/// The tour of R2 through the world `office-no-target`: corridor, three rooms and back.
[[nodiscard]] std::vector<Point2> office_tour();
/// The SPmap alone, told what the robot's sensors are like.
[[nodiscard]] MakeTracker sp_tracker();
/// Line SLAM told the same: a new local map every 10 m, loops not closed, so that the covariance goes through the
/// joins.
[[nodiscard]] MakeTracker local_maps_tracker();
/// The same, and it learns what the wheels are off by all the time.
[[nodiscard]] MakeTracker learning_tracker();

}  // namespace seeker::lab
