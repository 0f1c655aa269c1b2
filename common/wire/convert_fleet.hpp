/// \file
/// Values of a fleet to messages and back, as in convert.hpp.
#pragma once

#include "common/api/fleet.hpp"
#include "common/wire/check.hpp"
#include "seeker/v1/fleet.pb.h"

namespace seeker::wire {

inline constexpr std::uint32_t kFleetProtocol = 1;

void write(const api::FleetManifest& from, v1::FleetManifest* to);
void write(const api::FleetMissing& from, v1::FleetMissing* to);
void write(const api::FleetChunk& from, v1::FleetChunk* to);
void write(const api::FleetStatus& from, v1::FleetStatus* to);
void write(const api::FleetDecision& from, v1::FleetDecision* to);
void read(const v1::FleetManifest& from, api::FleetManifest& to, Check& check);
void read(const v1::FleetMissing& from, api::FleetMissing& to, Check& check);
void read(const v1::FleetChunk& from, api::FleetChunk& to, Check& check);
void read(const v1::FleetStatus& from, api::FleetStatus& to, Check& check);
void read(const v1::FleetDecision& from, api::FleetDecision& to, Check& check);

}  // namespace seeker::wire
