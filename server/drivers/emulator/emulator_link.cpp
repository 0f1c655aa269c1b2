#include "server/drivers/emulator/emulator_link.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/log/log.hpp"
#include "common/net/random_id.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/envelope.hpp"
#include "common/wire/outcome.hpp"
#include "server/drivers/emulator/emulator_wire.hpp"

namespace seeker::drivers {
namespace {

constexpr std::string_view kPart = "emulator";

}  // namespace

EmulatorLink::EmulatorLink(EmulatorParams params)
    : params_(std::move(params)),
      instance_(net::random_id()),
      backoff_(params_.retry_period, params_.max_retry_period) {}

EmulatorLink::~EmulatorLink() {
  if (connection_) {
    connection_->close();
    io_.restart();
    io_.poll();
  }
}

Result<std::shared_ptr<EmulatorLink>> EmulatorLink::connect(EmulatorParams params) {
  std::shared_ptr<EmulatorLink> link(new EmulatorLink(std::move(params)));
  link->try_connect();
  link->work_until([&] { return link->state_ == State::kUp || link->state_ == State::kDown; },
                   2 * link->params_.connect_timeout);
  if (link->state_ != State::kUp) {
    return fail_with_context("no world at " + link->params_.host + ":" + std::to_string(link->params_.port) +
                                 " (start seeker-emulator there, or set emulator.address)",
                             link->ended_.value_or(link->why_down_));
  }
  return link;
}

template <class Done>
bool EmulatorLink::work_until(Done done, Duration limit) {
  const wire::WallTime end = net::wall_now() + limit;
  while (!done()) {
    const wire::WallTime now = net::wall_now();
    if (now >= end) {
      return false;
    }
    io_.restart();
    io_.run_one_for(end - now);
  }
  return true;
}

void EmulatorLink::try_connect() {
  state_ = State::kConnecting;
  net::async_connect(
      io_, {params_.host, params_.port, params_.connect_timeout, params_.tls},
      [this](Result<net::Transport> transport) {
        if (transport) {
          greet(std::move(*transport));
        } else if (params_.tls) {
          lose(transport.error());
        } else {
          // What the error says to look after is for clients of a robot.
          lose({transport.error().code, "no emulator answers at " + params_.host + ":" + std::to_string(params_.port)});
        }
      });
}

void EmulatorLink::greet(net::Transport transport) {
  state_ = State::kGreeting;
  connection_ = std::make_shared<net::Connection>(std::move(transport), net::ConnectionParams{});
  net::Connection::Handlers handlers;
  handlers.on_frame = [this](std::string_view payload) { on_frame(payload); };
  handlers.next_frame = [this]() -> std::optional<wire::OutFrame> {
    if (outgoing_.empty()) {
      return std::nullopt;
    }
    wire::OutFrame frame = std::move(outgoing_.front());
    outgoing_.pop_front();
    return frame;
  };
  handlers.on_end = [this](const Error& error) { lose(error); };
  outgoing_.clear();
  v1::EmulatorRequest hello;
  hello.mutable_hello()->set_protocol(kEmulatorProtocol);
  hello.mutable_hello()->set_robot(params_.robot);
  hello.mutable_hello()->set_instance(instance_);
  send(hello);
  connection_->start(std::move(handlers));
}

void EmulatorLink::send(v1::EmulatorRequest& request) {
  request.set_id(++last_id_);
  outgoing_.push_back(wire::make_frame(request.SerializeAsString()));
  connection_->wake();
}

void EmulatorLink::on_frame(std::string_view payload) {
  v1::EmulatorReply reply;
  if (const Status parsed = wire::parse_within_limits(payload, reply); !parsed) {
    lose(parsed.error());
    return;
  }
  on_reply(std::move(reply));
}

void EmulatorLink::on_reply(v1::EmulatorReply reply) {
  if (state_ == State::kGreeting) {
    if (const Status welcome = take_welcome(reply); !welcome) {
      lose(welcome.error());
    }
    return;
  }
  const RobotTime now{Duration(reply.now_ns())};
  if (now < now_) {
    lose({Errc::kCorrupt, "the emulator's time runs backwards"});
    return;
  }
  now_ = now;
  if (reply.id() == last_call_) {
    answer_ = std::move(reply);
  } else if (reply.id() == advance_id_) {
    advance_id_ = 0;
    if (const Status went_on = wire::status_of(reply.error()); !went_on) {
      lose(went_on.error());
    }
  }
}

Status EmulatorLink::take_welcome(const v1::EmulatorReply& reply) {
  if (Status accepted = wire::status_of(reply.error()); !accepted) {
    return accepted;
  }
  wire::Check check;
  read(reply.welcome().stereo(), stereo_, check);
  speed_ = check.finite("speed", reply.welcome().speed());
  if (!check.ok()) {
    return check.status();
  }
  if (world_id_ && *world_id_ != reply.welcome().world_id()) {
    ended_ = Error{Errc::kCancelled, "the emulator was restarted and this robot's world is gone"};
    return tl::unexpected<Error>(*ended_);
  }
  world_id_ = reply.welcome().world_id();
  lockstep_ = reply.welcome().lockstep();
  now_ = std::max(now_, RobotTime(Duration(reply.now_ns())));
  advance_id_ = 0;
  state_ = State::kUp;
  backoff_.reset();
  log::info(kPart, "robot " + std::to_string(params_.robot) + " is in the world at " + params_.host + ":" +
                       std::to_string(params_.port));
  return {};
}

void EmulatorLink::lose(const Error& error) {
  if (state_ == State::kUp) {
    log::warning(kPart, "the link to the world is down: " + error.message);
  }
  why_down_ = error;
  state_ = State::kDown;
  next_try_ = net::wall_now() + backoff_.next();
  outgoing_.clear();
  if (connection_) {
    connection_->close();
    connection_.reset();
  }
}

Status EmulatorLink::reachable() const {
  if (ended_) {
    return tl::unexpected<Error>(*ended_);
  }
  return state_ == State::kUp ? Status() : fail_with_context("the simulated world cannot be reached", why_down_);
}

Result<v1::EmulatorReply> EmulatorLink::call(v1::EmulatorRequest request) {
  if (const Status there = reachable(); !there) {
    return tl::unexpected<Error>(there.error());
  }
  send(request);
  last_call_ = last_id_;
  answer_.reset();
  if (!work_until([this] { return answer_ || state_ != State::kUp; }, params_.call_timeout)) {
    lose({Errc::kTimeout, "the emulator does not answer"});
  }
  if (!answer_) {
    return tl::unexpected<Error>(reachable().error());
  }
  if (const Status done = wire::status_of(answer_->error()); !done) {
    return tl::unexpected<Error>(done.error());
  }
  return std::move(*answer_);
}

void EmulatorLink::advance(Duration period) {
  if (state_ != State::kUp) {
    return;
  }
  v1::EmulatorRequest request;
  request.set_advance_ns(period.count());
  send(request);
  advance_id_ = last_id_;
}

Result<bool> EmulatorLink::await(Duration limit) {
  const auto arrived = [this] {
    if (state_ == State::kDown && !ended_ && net::wall_now() >= next_try_) {
      try_connect();
    }
    return ended_ || (state_ == State::kUp && advance_id_ == 0);
  };
  // While the link is down no handler wakes this thread: it checks the clock again after `limit`, which callers keep
  // short.
  const bool there = work_until(arrived, limit);
  if (ended_) {
    return tl::unexpected<Error>(*ended_);
  }
  return there;
}

}  // namespace seeker::drivers
