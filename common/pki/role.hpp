/// \file
/// What a certificate allows its owner.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace seeker::pki {

/// Written as the organisational unit (OU) of the certificate's subject.
enum class Role : std::uint8_t {
  kObserver,  ///< a person who may read, and stop the robot
  kOperator,  ///< a person who may command
  kAdmin,     ///< a person who may do everything
  kRobot,     ///< a program that serves (seekerd, seeker-emulator) and that joins fleets and worlds
};

inline constexpr std::array kRoles{Role::kObserver, Role::kOperator, Role::kAdmin, Role::kRobot};

/// Stable lower-case name, as in certificates and on the command line.
[[nodiscard]] std::string_view to_string(Role role);
/// The role of that name; std::nullopt for any other text.
[[nodiscard]] std::optional<Role> parse_role(std::string_view name);

}  // namespace seeker::pki
