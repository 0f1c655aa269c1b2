/// \file
/// What a robot file says about the protection of the robot's ports and links.
#pragma once

#include "common/config/fields.hpp"
#include "common/core/result.hpp"
#include "common/net/link_security.hpp"
#include "server/app/composition/robot_options.hpp"

namespace seeker::net {

/// The section `server.tls`.
void describe(config::Fields& f, LinkSecurity& params);

}  // namespace seeker::net

namespace seeker::server_net {

/// The section `server`.
void describe(config::Fields& f, ServerParams& params);

}  // namespace seeker::server_net

namespace seeker::app {

/// The field `port`.
void describe_port(config::Fields& f, std::uint16_t& number);

/// The section `metrics`.
void describe(config::Fields& f, MetricsSettings& settings);

/// The sections `server.tls` and `server.insecure` with paths that can be opened: they hold for the robot's own port,
/// for that of its fleet, and for its links to a main robot and to an emulator.
[[nodiscard]] net::LinkSecurity link_security(const RobotOptions& options);

/// Whether the robot's ports may be opened as its file says, and the certificates it names can be used. The error names
/// the remedy.
[[nodiscard]] Status check_links(const RobotOptions& options);

}  // namespace seeker::app
