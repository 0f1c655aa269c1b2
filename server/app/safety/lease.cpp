#include "server/app/safety/lease.hpp"

#include <algorithm>
#include <utility>

namespace seeker::app {
namespace {

tl::unexpected<Error> held_by(const std::string& owner) {
  return fail(Errc::kRefused, "'" + owner +
                                  "' holds the lease; ask for it with 'seeker lease request', wait until it is "
                                  "released, or take it over with 'seeker drive --take-over'");
}

}  // namespace

Result<api::LeaseState> Lease::command(const api::Caller& caller, const api::LeaseCommand& command, WallTime now) {
  const std::string& client = caller.client_name;
  switch (command.action) {
    case api::LeaseAction::kAcquire: return acquire(client);
    case api::LeaseAction::kTakeOver: return take_over(caller, command.intended);
    case api::LeaseAction::kRequest: return request(client, now);
    case api::LeaseAction::kGrant: return answer(client, true);
    case api::LeaseAction::kDeny: return answer(client, false);
    case api::LeaseAction::kRelease:
      if (state_.owner == client) {
        hand_over(state_.requested_by);
      }
      return state_;
  }
  return fail(Errc::kInvalidArgument, "unknown lease action");
}

Result<api::LeaseState> Lease::acquire(const std::string& client) {
  if (const Status free = free_for(client); !free) {
    return tl::unexpected<Error>(free.error());
  }
  if (state_.owner != client) {
    hand_over(client);
  }
  state_.stale = false;
  return state_;
}

Result<api::LeaseState> Lease::take_over(const api::Caller& caller, bool intended) {
  const bool free = free_for(caller.client_name).has_value();
  if (!free && caller.role < api::Role::kAdmin && !intended) {
    return fail(Errc::kRefused, "'" + state_.owner +
                                    "' holds the lease; only an admin takes it over without saying that a person "
                                    "wants it, as 'seeker lease take-over --yes' does");
  }
  if (!free) {
    hand_over(caller.client_name);
  }
  return acquire(caller.client_name);
}

Result<api::LeaseState> Lease::request(const std::string& client, WallTime now) {
  if (free_for(client)) {
    return acquire(client);
  }
  if (!state_.requested_by.empty() && state_.requested_by != client) {
    return fail(Errc::kRefused, "'" + state_.requested_by + "' asks '" + state_.owner +
                                    "', who holds the lease, for it already; ask again when that is answered");
  }
  state_.requested_by = client;
  state_.request_left = params_.request_timeout;
  request_until_ = now + params_.request_timeout;
  return state_;
}

Result<api::LeaseState> Lease::answer(const std::string& client, bool grant) {
  if (state_.owner != client) {
    return fail(Errc::kRefused, state_.owner.empty()
                                    ? "nobody holds the lease; 'seeker lease acquire' takes it"
                                    : "only '" + state_.owner +
                                          "', who holds the lease, may answer; '--as NAME' gives a client that name");
  }
  if (state_.requested_by.empty()) {
    return fail(Errc::kNotFound, "nobody asks '" + client + "' for the lease; a request may have timed out");
  }
  if (grant) {
    hand_over(state_.requested_by);
  } else {
    drop_request();
  }
  return state_;
}

void Lease::forget(const std::string& client) {
  if (state_.requested_by == client) {
    drop_request();
  }
  if (state_.owner == client) {
    hand_over(state_.requested_by);
  }
}

void Lease::silent(const std::string& client) {
  if (state_.requested_by == client) {
    drop_request();
  }
  if (state_.owner != client || state_.stale) {
    return;
  }
  if (!state_.requested_by.empty()) {
    hand_over(state_.requested_by);
    return;
  }
  new_epoch(Voided{state_.epoch, true});
  state_.stale = true;
}

void Lease::void_commands() {
  if (!state_.owner.empty()) {
    new_epoch(Voided{state_.epoch, false});
  }
}

bool Lease::watch(WallTime now) {
  if (!request_until_) {
    return false;
  }
  state_.request_left = std::max(Duration::zero(), Duration(*request_until_ - now));
  if (state_.request_left > Duration::zero()) {
    return false;
  }
  drop_request();
  return true;
}

Status Lease::take(const std::string& client, std::uint64_t epoch, std::uint64_t sequence) {
  if (state_.owner != client) {
    return state_.owner.empty() ? fail(Errc::kRefused, "driving needs the lease, which nobody holds; acquire it first")
                                : Status(held_by(state_.owner));
  }
  if (state_.stale || (voided_ && epoch == voided_->epoch && voided_->stale)) {
    return fail(Errc::kRefused,
                "the lease of '" + client + "' is stale, since it was not heard; acquire it again to go on");
  }
  if (voided_ && epoch == voided_->epoch) {
    return fail(Errc::kRefused, "the robot was stopped while it was driven by hand; acquire the lease again to go on");
  }
  if (epoch != state_.epoch) {
    return fail(Errc::kRefused, "the command belongs to an earlier lease; acquire the lease again");
  }
  if (sequence != 0 && sequence <= state_.sequence) {
    return fail(Errc::kRefused, "the command was overtaken by a later one of '" + client + "'; send new ones only");
  }
  state_.sequence = std::max(state_.sequence, sequence);
  return {};
}

Status Lease::free_for(const std::string& client) const {
  const bool free = state_.owner.empty() || state_.owner == client || state_.stale;
  return free ? Status() : Status(held_by(state_.owner));
}

void Lease::hand_over(const std::string& client) {
  state_.owner = client;
  state_.stale = false;
  drop_request();
  new_epoch(std::nullopt);
}

void Lease::new_epoch(std::optional<Voided> before) {
  ++state_.epoch;
  state_.sequence = 0;
  voided_ = before;
}

void Lease::drop_request() {
  state_.requested_by.clear();
  state_.request_left = Duration::zero();
  request_until_.reset();
}

}  // namespace seeker::app
