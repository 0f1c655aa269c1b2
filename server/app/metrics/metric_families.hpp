/// \file
/// Families of metrics out of values that were taken at one moment.
#pragma once

#include <vector>

#include <prometheus/metric_family.h>

#include "common/api/robot_state.hpp"
#include "server/net/server.hpp"

namespace seeker::app {

/// What the robot is doing: motion, battery, mission, faults, lateness of the loop.
void add_status(const api::RobotStatus& status, std::vector<prometheus::MetricFamily>& families);
/// What goes over the network.
void add_network(const server_net::ServerStats& stats, std::vector<prometheus::MetricFamily>& families);

}  // namespace seeker::app
