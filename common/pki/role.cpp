#include "common/pki/role.hpp"

namespace seeker::pki {

std::string_view to_string(Role role) {
  switch (role) {
    case Role::kObserver: return "observer";
    case Role::kOperator: return "operator";
    case Role::kAdmin: return "admin";
    case Role::kRobot: return "robot";
  }
  return "observer";
}

std::optional<Role> parse_role(std::string_view name) {
  for (const Role role : kRoles) {
    if (to_string(role) == name) {
      return role;
    }
  }
  return std::nullopt;
}

}  // namespace seeker::pki
