/// \file
/// Conversion of the values of a fleet to messages and back, as in convert.hpp.
#pragma once

#include "common/api/fleet.hpp"
#include "common/wire/check.hpp"
#include "seeker/v1/fleet.pb.h"

namespace seeker::wire {

inline constexpr std::uint32_t kFleetProtocol = 2;

void write(const api::FleetManifest& from, v1::FleetManifest* to);
void write(const api::FleetMissing& from, v1::FleetMissing* to);
void write(const api::FleetChunk& from, v1::FleetChunk* to);
/// Writes a topology; sectors are sent in single precision.
void write(const RobotTopology& from, v1::FleetTopology* to);
void write(const api::FleetShare& from, v1::FleetShare* to);
/// Writes the fields of a reply to a share.
void write(const api::FleetShared& from, v1::FleetReply* to);
void write(const SearchedFloor& from, v1::SearchedFloor* to);
void write(const api::FleetSeen& from, v1::FleetSeen* to);
/// Writes the fields of a reply to what a robot has seen.
void write(const api::FleetSightings& from, v1::FleetReply* to);
/// Writes the fields of a reply to who asks for the scene.
void write(const api::FleetScene& from, v1::FleetReply* to);
void write(const api::FleetStatus& from, v1::FleetStatus* to);
void write(const api::FleetDecision& from, v1::FleetDecision* to);
void read(const v1::FleetManifest& from, api::FleetManifest& to, Check& check);
void read(const v1::FleetMissing& from, api::FleetMissing& to, Check& check);
void read(const v1::FleetChunk& from, api::FleetChunk& to, Check& check);
/// Reads a topology. Ids must rise, edges and the present node must refer to nodes of the message, and all positions
/// must lie within reach (see api::in_reach()).
void read(const v1::FleetTopology& from, RobotTopology& to, Check& check);
void read(const v1::FleetShare& from, api::FleetShare& to, Check& check);
void read(const v1::FleetReply& from, api::FleetShared& to, Check& check);
void read(const v1::SearchedFloor& from, SearchedFloor& to, Check& check);
void read(const v1::FleetSeen& from, api::FleetSeen& to, Check& check);
void read(const v1::FleetReply& from, api::FleetSightings& to, Check& check);
void read(const v1::FleetReply& from, api::FleetScene& to, Check& check);
void read(const v1::FleetStatus& from, api::FleetStatus& to, Check& check);
void read(const v1::FleetDecision& from, api::FleetDecision& to, Check& check);

}  // namespace seeker::wire
