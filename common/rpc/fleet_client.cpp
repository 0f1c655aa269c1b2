#include "common/rpc/fleet_client.hpp"

#include <utility>

#include "common/net/exchange.hpp"
#include "common/rpc/answers.hpp"
#include "common/wire/convert_fleet.hpp"
#include "common/wire/envelope.hpp"

namespace seeker::rpc {
namespace {

Result<api::FleetStatus> fleet_of(const Result<pb::FleetReply>& reply) {
  return reply ? wire::from_message<api::FleetStatus>(reply->fleet()) : tl::unexpected<Error>(reply.error());
}

}  // namespace

struct FleetClient::Link {
  Endpoint main;
  Duration timeout;
  std::optional<pki::BundleFiles> tls;
  std::unique_ptr<net::Exchange> exchange;

  Result<pb::FleetReply> ask(pb::FleetRequest request) {
    if (!exchange) {
      Result<std::unique_ptr<net::Exchange>> connected = net::Exchange::connect({main.host, main.port, timeout, tls});
      if (!connected) {
        return fail_with_context(
            "no main robot of a fleet answers (fleet.lead: true in its robot file, --main names it)",
            connected.error());
      }
      exchange = std::move(*connected);
    }
    request.set_protocol(wire::kFleetProtocol);
    const Result<std::string> payload = exchange->ask(request.SerializeAsString(), timeout);
    pb::FleetReply reply;
    const Status parsed =
        payload ? wire::parse_within_limits(*payload, reply) : Status(tl::unexpected<Error>(payload.error()));
    if (!parsed) {
      exchange.reset();
      return tl::unexpected<Error>(parsed.error());
    }
    if (const Status done = wire::status_of(reply.error()); !done) {
      if (done.error().message.empty()) {  // another protocol, which reads as this one
        return fail(Errc::kRefused, main.host + ":" + std::to_string(main.port) +
                                        " does not answer as the main robot of a fleet; give its fleet port");
      }
      return tl::unexpected<Error>(done.error());
    }
    return reply;
  }
};

FleetClient::FleetClient(Endpoint main, Duration call_timeout, std::optional<pki::BundleFiles> tls)
    : link_(std::make_unique<Link>(Link{std::move(main), call_timeout, std::move(tls), nullptr})) {}

FleetClient::FleetClient(FleetClient&&) noexcept = default;
FleetClient& FleetClient::operator=(FleetClient&&) noexcept = default;
FleetClient::~FleetClient() = default;

Result<api::FleetAnswer> FleetClient::announce(const api::FleetManifest& manifest) {
  pb::FleetRequest request;
  wire::write(manifest, request.mutable_announce());
  const Result<pb::FleetReply> reply = link_->ask(std::move(request));
  Result<api::FleetStatus> fleet = fleet_of(reply);
  if (!fleet) {
    return tl::unexpected<Error>(fleet.error());
  }
  Result<std::vector<api::FleetMissing>> missing = read_list<api::FleetMissing>(reply->missing(), api::kMaxFleetNodes);
  if (!missing) {
    return tl::unexpected<Error>(missing.error());
  }
  return api::FleetAnswer{std::move(*missing), std::move(*fleet)};
}

Result<api::FleetShared> FleetClient::share(const api::FleetShare& share) {
  pb::FleetRequest request;
  wire::write(share, request.mutable_share());
  const Result<pb::FleetReply> reply = link_->ask(std::move(request));
  return reply ? wire::from_message<api::FleetShared>(*reply) : tl::unexpected<Error>(reply.error());
}

Result<api::FleetSightings> FleetClient::seen(const api::FleetSeen& seen) {
  pb::FleetRequest request;
  wire::write(seen, request.mutable_seen());
  const Result<pb::FleetReply> reply = link_->ask(std::move(request));
  return reply ? wire::from_message<api::FleetSightings>(*reply) : tl::unexpected<Error>(reply.error());
}

Result<std::uint64_t> FleetClient::send(const api::FleetChunk& chunk) {
  pb::FleetRequest request;
  wire::write(chunk, request.mutable_chunk());
  const Result<pb::FleetReply> reply = link_->ask(std::move(request));
  return reply ? Result<std::uint64_t>(reply->received_bytes()) : tl::unexpected<Error>(reply.error());
}

Result<api::FleetStatus> FleetClient::status() {
  pb::FleetRequest request;
  request.set_status(true);
  return fleet_of(link_->ask(std::move(request)));
}

Result<api::FleetStatus> FleetClient::decide(const api::FleetDecision& decision) {
  pb::FleetRequest request;
  wire::write(decision, request.mutable_decide());
  return fleet_of(link_->ask(std::move(request)));
}

Result<api::FleetScene> FleetClient::scene() {
  pb::FleetRequest request;
  request.set_scene(true);
  const Result<pb::FleetReply> reply = link_->ask(std::move(request));
  return reply ? wire::from_message<api::FleetScene>(*reply) : tl::unexpected<Error>(reply.error());
}

Result<std::vector<std::uint8_t>> FleetClient::map() {
  pb::FleetRequest request;
  request.set_map(true);
  const Result<pb::FleetReply> reply = link_->ask(std::move(request));
  if (!reply) {
    return tl::unexpected<Error>(reply.error());
  }
  return std::vector<std::uint8_t>(reply->file().begin(), reply->file().end());
}

}  // namespace seeker::rpc
