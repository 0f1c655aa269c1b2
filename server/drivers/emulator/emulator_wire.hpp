/// \file
/// Values and messages exchanged between seeker-emulator and the robots in its world.
#pragma once

#include "common/core/stereo.hpp"
#include "common/wire/check.hpp"
#include "seeker/v1/emulator.pb.h"
#include "server/drivers/interfaces/drivers.hpp"

namespace seeker::drivers {

inline constexpr std::uint32_t kEmulatorProtocol = 1;
inline constexpr std::uint16_t kEmulatorPort = 7472;
/// A robot's request is small; a larger frame is not a valid request.
inline constexpr std::size_t kMaxEmulatorRequestBytes = 4096;

void write(const OdometrySample& from, v1::EmulatorOdometry* to);
void read(const v1::EmulatorOdometry& from, OdometrySample& to, wire::Check& check);
void write(const StereoGeometry& from, v1::EmulatorStereoGeometry* to);
void read(const v1::EmulatorStereoGeometry& from, StereoGeometry& to, wire::Check& check);

}  // namespace seeker::drivers
