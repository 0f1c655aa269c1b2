/// \file
/// Explorations of toy worlds, and what their runs tell.
#pragma once

#include <algorithm>
#include <iostream>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/unit/server/explore/toy_worlds.hpp"

namespace seeker::explore {

inline Exploration exploration_of(const ExploreRequest& request, const ExploreParams& params = {}) {
  auto exploration = Exploration::create(request, params);
  EXPECT_TRUE(exploration.has_value()) << (exploration ? "" : exploration.error().message);
  return std::move(*exploration);
}

inline ExploreRequest request_of(Strategy strategy) {
  ExploreRequest request;
  request.strategy = maker_of(strategy);
  return request;
}

inline void print(const char* name, const ToyRun& run) {
  std::cout << name << ": " << (run.end ? run.end->cause : "no end") << "; " << run.seconds << " s, " << run.path_m
            << " m, clearance " << run.least_clearance_m << " m, walls " << run.wall_share << ", progress "
            << run.progress << ", decisions " << run.decisions.size() << '\n';
}

inline bool has_event(const ToyRun& run, const std::string& kind) {
  return std::any_of(run.events.begin(), run.events.end(), [&](const ExploreEvent& e) { return e.kind == kind; });
}

}  // namespace seeker::explore
