#include "server/app/composition/link_options.hpp"

#include <filesystem>
#include <string>

#include "common/net/tls_context.hpp"

namespace seeker::net {
namespace {

void describe_path(config::Fields& f, std::string_view key, std::filesystem::path& path) {
  std::string text = path.string();
  f.field(key, text);
  path = text;
}

void describe_count(config::Fields& f, std::string_view key, std::size_t& count) {
  std::uint64_t number = count;
  f.field(key, number);
  f.check(key, number > 0, "must be above 0");
  count = number;
}

}  // namespace

void describe(config::Fields& f, LockoutParams& params) {
  describe_count(f, "failures", params.failures);
  f.seconds("within_s", params.within);
  f.check("within_s", params.within > Duration::zero(), "must be above 0");
  f.seconds("for_s", params.duration);
  f.check("for_s", params.duration >= Duration::zero(), "must be 0 or more");
  f.field("loopback", params.loopback);
}

void describe(config::Fields& f, LinkSecurity& params) {
  describe_path(f, "certificate", params.files.certificate);
  describe_path(f, "key", params.files.key);
  describe_path(f, "ca", params.files.ca);
  describe_path(f, "revocations", params.files.revocations);
  const bool whole = params.files.certificate.empty() == params.files.key.empty() &&
                     params.files.certificate.empty() == params.files.ca.empty();
  f.check("certificate", whole, "certificate, key and ca belong together: name all three files, or none");
  f.seconds("handshake_s", params.handshake.timeout);
  f.check("handshake_s", params.handshake.timeout > Duration::zero(), "must be above 0");
  describe_count(f, "handshakes", params.handshake.in_progress);
  f.section("lockout", params.lockout);
}

}  // namespace seeker::net

namespace seeker::server_net {
void describe(config::Fields& f, ServerParams& params) {
  f.field("address", params.address);
  app::describe_port(f, params.port);
  f.section("tls", params.security);
  f.field("insecure", params.security.insecure);
  f.seconds("heartbeat_s", params.heartbeat);
  f.seconds("lost_after_s", params.lost_after);
}

}  // namespace seeker::server_net

namespace seeker::app {

void describe_port(config::Fields& f, std::uint16_t& number) {
  int port = number;
  f.field("port", port);
  constexpr int kHighestPort = 65535;
  const bool valid = port >= 0 && port <= kHighestPort;
  f.check("port", valid, "must be from 0 to 65535");
  number = valid ? static_cast<std::uint16_t>(port) : number;
}

void describe(config::Fields& f, MetricsSettings& settings) {
  f.field("address", settings.address);
  describe_port(f, settings.port);
  const Status ok = validate(settings);
  f.check("address", ok.has_value(), ok ? "" : ok.error().message);
}

net::LinkSecurity link_security(const RobotOptions& options) {
  net::LinkSecurity security = options.server.security;
  for (std::filesystem::path* file :
       {&security.files.certificate, &security.files.key, &security.files.ca, &security.files.revocations}) {
    *file = file->empty() ? std::filesystem::path() : resolve(options, file->string());
  }
  return security;
}

Status check_links(const RobotOptions& options) {
  const net::LinkSecurity security = link_security(options);
  if (const Status allowed = net::check_allowed(options.server.address, security); !allowed) {
    return fail_with_context("server", allowed.error());
  }
  const Status fleet = options.fleet.lead ? net::check_allowed(options.fleet.address, security) : Status();
  if (!fleet) {
    return fail_with_context("fleet", fleet.error());
  }
  if (options.emulator.tls && !security.tls()) {
    return fail(Errc::kInvalidArgument, "emulator.tls: needs the certificates of server.tls");
  }
  if (security.tls()) {
    if (const auto files = net::TlsContext::make(security.files, net::TlsSide::kServer); !files) {
      return fail_with_context("server.tls", files.error());
    }
  }
  return {};
}

}  // namespace seeker::app
