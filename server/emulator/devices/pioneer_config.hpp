/// \file
/// The configuration that an emulated base reports (protocols 1.7).
#pragma once

#include "server/emulator/devices/p2os_device_params.hpp"
#include "server/protocols/p2os/config_packet.hpp"

namespace seeker::emulator {

/// Pulses of the wheel encoders in a millimetre.
inline constexpr std::uint16_t kTicksPerMm = 138;

/// All fields of ARCOS firmware up to the battery's shutdown and the firmware's version.
[[nodiscard]] p2os::ConfigPacket config_of(const P2osDeviceParams& params);

}  // namespace seeker::emulator
