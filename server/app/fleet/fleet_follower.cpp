#include "server/app/fleet/fleet_follower.hpp"

#include <algorithm>
#include <utility>

#include "common/log/log.hpp"
#include "common/net/random_id.hpp"
#include "common/rpc/wait.hpp"
#include "server/app/fleet/fleet_settings.hpp"

namespace seeker::app {
namespace {

/// Small enough that a piece is not sent for long in vain when the link is cut.
constexpr std::size_t kChunkBytes = 256UL << 10U;

/// Nothing else would come through either.
bool is_of_link(Errc code) { return code == Errc::kLinkLost || code == Errc::kTimeout; }

}  // namespace

FleetFollower::FleetFollower(FleetFollowerParams params, FleetHost host)
    : params_(std::move(params)),
      host_(std::move(host)),
      instance_(net::random_id()),
      main_(params_.main, params_.call_timeout, params_.tls),
      others_(params_.robot_id, host_),
      last_(fail(Errc::kNotReady, "the main robot has not answered yet")),
      thread_([this] { run(); }) {}

FleetFollower::~FleetFollower() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

bool FleetFollower::stopping() const {
  const std::lock_guard lock(mutex_);
  return stopping_;
}

Result<api::FleetStatus> FleetFollower::status() const {
  const std::lock_guard lock(mutex_);
  if (fleet_) {
    return *fleet_;
  }
  return fail_with_context("the main robot at " + rpc::to_string(params_.main), last_.error());
}

void FleetFollower::run() {
  for (;;) {
    note(once());
    std::unique_lock lock(mutex_);
    if (wake_.wait_for(lock, params_.share_period, [this] { return stopping_; })) {
      return;
    }
  }
}

void FleetFollower::note(const Status& outcome) {
  const std::lock_guard lock(mutex_);
  const bool same =
      outcome.has_value() == last_.has_value() && (outcome.has_value() || outcome.error() == last_.error());
  if (same) {
    return;
  }
  if (outcome) {
    log::info(kFleetPart, "this robot is in the fleet of " + rpc::to_string(params_.main));
  } else {
    log::warning(kFleetPart, "this robot goes on alone: " + outcome.error().message);
  }
  last_ = outcome;
}

Status FleetFollower::once() {
  if (std::chrono::steady_clock::now() >= announce_at_) {
    if (Status announced = announce(); !announced) {
      others_.receive(Result<api::FleetShared>(tl::unexpected<Error>(announced.error())));
      return announced;
    }
    announce_at_ = std::chrono::steady_clock::now() + params_.period;
  }
  Status exchanged;
  if (std::chrono::steady_clock::now() >= floor_at_) {
    exchanged = exchange_seen();
    if (!exchanged && is_of_link(exchanged.error().code)) {
      return exchanged;
    }
    if (exchanged) {
      floor_at_ = std::chrono::steady_clock::now() + params_.floor_period;
    }
  }
  // Where what others have seen cannot be read, where they go is heard all the same.
  const Status shared = share();
  return shared ? exchanged : shared;
}

/// What the others have seen goes to the robot with the next share.
Status FleetFollower::exchange_seen() {
  Result<OwnSeen> own = rpc::wait<OwnSeen>(host_.give_seen, params_.call_timeout);
  if (!own) {
    return tl::unexpected<Error>(own.error());
  }
  Result<api::FleetSightings> others = main_.seen({.robot_id = params_.robot_id,
                                                   .instance = instance_,
                                                   .placed = own->placed,
                                                   .tiles = std::move(own->floor),
                                                   .detections = std::move(own->detections),
                                                   .searched = std::move(own->searched),
                                                   .sides = std::move(own->sides)});
  if (others) {
    others_.receive(std::move(*others));
    return {};
  }
  return others.error().code == Errc::kNotFound ? Status() : Status(tl::unexpected<Error>(others.error()));
}

Status FleetFollower::announce() {
  Result<OwnMap> own = rpc::wait<OwnMap>(host_.give_map, params_.call_timeout);
  if (!own) {
    return tl::unexpected<Error>(own.error());
  }
  Result<PackedMap> packed = pack_map(own->map, params_.robot_id, own->pictures);
  if (!packed) {
    return tl::unexpected<Error>(packed.error());
  }
  packed->manifest.instance = instance_;
  packed->manifest.map_T_base = own->map_T_base;
  Result<api::FleetAnswer> answer = main_.announce(packed->manifest);
  if (!answer) {
    return tl::unexpected<Error>(answer.error());
  }
  {
    const std::lock_guard lock(mutex_);
    fleet_ = std::move(answer->fleet);
  }
  for (const api::FleetMissing& missing : answer->missing) {
    if (Status sent = send(*packed, missing); !sent) {
      return sent;
    }
  }
  return {};
}

Status FleetFollower::share() {
  share_at_ = std::chrono::steady_clock::now() + params_.share_period;
  Result<OwnTopology> own = rpc::wait<OwnTopology>(host_.give_topology, params_.call_timeout);
  if (!own) {
    return tl::unexpected<Error>(own.error());
  }
  api::FleetShare reported{params_.robot_id, instance_, std::nullopt};
  if (*own) {
    reported.topology = api::within_limits(**std::move(own));
  }
  const Result<api::FleetShared> shared = main_.share(reported);
  others_.receive(shared);
  if (!shared && shared.error().code == Errc::kNotFound) {
    announce_at_ = {};  // it has forgotten this robot, or was started anew
    return {};
  }
  return shared ? Status() : Status(tl::unexpected<Error>(shared.error()));
}

Status FleetFollower::send(const PackedMap& packed, const api::FleetMissing& missing) {
  const auto piece = packed.pieces.find(missing.hash);
  if (piece == packed.pieces.end()) {
    return fail(Errc::kNotFound, "the main robot asks for a piece that was not announced");
  }
  const std::vector<std::uint8_t>& bytes = *piece->second;
  std::uint64_t at = missing.offset;
  while (at < bytes.size()) {
    if (stopping()) {
      return fail(Errc::kCancelled, "this robot is shutting down");
    }
    const std::size_t end = std::min<std::size_t>(bytes.size(), at + kChunkBytes);
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const api::FleetChunk chunk{
        params_.robot_id, missing.hash, at, {begin, bytes.begin() + static_cast<std::ptrdiff_t>(end)}};
    const Result<std::uint64_t> received = main_.send(chunk);
    if (!received) {
      return tl::unexpected<Error>(received.error());
    }
    if (*received <= at) {
      return fail(Errc::kCorrupt, "the main robot does not take a piece of the map");
    }
    at = *received;
    if (std::chrono::steady_clock::now() >= share_at_) {
      if (Status shared = share(); !shared) {
        return shared;
      }
    }
  }
  return {};
}

}  // namespace seeker::app
