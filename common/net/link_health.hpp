/// \file
/// What an operator should know of a port's protection.
#pragma once

#include <optional>
#include <string>

#include "common/core/result.hpp"
#include "common/pki/certificate.hpp"

namespace seeker::net {

struct LinkHealth {
  bool tls = false;
  bool insecure = false;         ///< plain TCP beyond loopback
  std::string address;           ///< of the interface
  std::string name;              ///< of the own certificate
  pki::CalendarTime expires;     ///< the own certificate
  std::optional<Error> problem;  ///< why the newest files are not used; the former ones are
};

}  // namespace seeker::net
