#include "server/app/fleet_follower.hpp"

#include <algorithm>
#include <utility>

#include "common/log/log.hpp"
#include "common/net/random_id.hpp"
#include "common/rpc/wait.hpp"

namespace seeker::app {
namespace {

constexpr std::string_view kPart = "fleet";
/// Small enough that a piece is not sent for long in vain when the link is cut.
constexpr std::size_t kChunkBytes = 256UL << 10U;

}  // namespace

FleetFollower::FleetFollower(FleetFollowerParams params, OwnMapSource own_map)
    : params_(std::move(params)),
      own_map_(std::move(own_map)),
      instance_(net::random_id()),
      main_(params_.main, params_.call_timeout),
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
    if (wake_.wait_for(lock, params_.period, [this] { return stopping_; })) {
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
    log::info(kPart, "this robot is in the fleet of " + rpc::to_string(params_.main));
  } else {
    log::warning(kPart, "this robot goes on alone: " + outcome.error().message);
  }
  last_ = outcome;
}

Status FleetFollower::once() {
  Result<OwnMap> own = ask_own_map();
  if (!own) {
    return tl::unexpected<Error>(own.error());
  }
  Result<PackedMap> packed = pack_map(own->map, params_.robot_id);
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

Result<OwnMap> FleetFollower::ask_own_map() const { return rpc::wait<OwnMap>(own_map_, params_.call_timeout); }

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
  }
  return {};
}

}  // namespace seeker::app
