/// \file
/// What a record of who commanded what says of a request.
#pragma once

#include <optional>
#include <string>

#include "seeker/v1/calls.pb.h"

namespace seeker::server_net {

/// What a request asks for, in a few words on one line of at most api::kMaxAuditEssentials_bytes. Nothing: it changes
/// nothing, so that nobody has to know of it.
[[nodiscard]] std::optional<std::string> audit_essentials(const seeker::v1::Request& request);

}  // namespace seeker::server_net
