#include "server/emulator/world_host.hpp"

#include <cmath>
#include <string>

#include "common/wire/convert.hpp"
#include "common/wire/outcome.hpp"
#include "server/drivers/emulator/emulator_wire.hpp"

namespace seeker::emulator {
namespace {

/// No robot's tick is longer; a larger step is a mistake or malice.
constexpr Duration kMaxTick = std::chrono::seconds(10);

drivers::Driver* device_of(drivers::SimDevices& robot, v1::EmulatorDevice device) {
  switch (device) {
    case v1::EMULATOR_DEVICE_BASE: return robot.base.get();
    case v1::EMULATOR_DEVICE_LIDAR: return robot.lidar.get();
    case v1::EMULATOR_DEVICE_SONAR: return robot.sonar.get();
    case v1::EMULATOR_DEVICE_CAMERA: return robot.camera.get();
    case v1::EMULATOR_DEVICE_STEREO: return robot.stereo.get();
    default: return nullptr;
  }
}

tl::unexpected<Error> no_such_device() {
  return fail(Errc::kInvalidArgument, "the emulator has no such device, or it cannot do this");
}

/// Writes a sample, where there is one, with `put`.
template <class Sample, class Put>
Status write_sample(const Result<std::optional<Sample>>& sample, Put put) {
  if (!sample) {
    return tl::unexpected<Error>(sample.error());
  }
  if (*sample) {
    put(**sample);
  }
  return {};
}

Status read(drivers::SimDevices& robot, v1::EmulatorDevice device, v1::EmulatorReply& reply) {
  switch (device) {
    case v1::EMULATOR_DEVICE_BASE:
      return write_sample(robot.base->read(),
                          [&](const auto& sample) { drivers::write(sample, reply.mutable_odometry()); });
    case v1::EMULATOR_DEVICE_LIDAR:
      return write_sample(robot.lidar->read(), [&](const auto& sample) { wire::write(sample, reply.mutable_scan()); });
    case v1::EMULATOR_DEVICE_SONAR:
      return write_sample(robot.sonar->read(), [&](const auto& sample) { wire::write(sample, reply.mutable_sonar()); });
    default: return no_such_device();
  }
}

Status grab(drivers::SimDevices& robot, v1::EmulatorDevice device, v1::EmulatorReply& reply) {
  if (device == v1::EMULATOR_DEVICE_CAMERA) {
    const Result<CameraFrame> frame = robot.camera->grab();
    if (!frame) {
      return tl::unexpected<Error>(frame.error());
    }
    reply.mutable_picture()->set_stamp_ns(frame->stamp.time_since_epoch().count());
    wire::write(frame->image, reply.mutable_picture()->mutable_image());
    return {};
  }
  if (device == v1::EMULATOR_DEVICE_STEREO) {
    const Result<StereoFrame> frame = robot.stereo->grab();
    if (!frame) {
      return tl::unexpected<Error>(frame.error());
    }
    reply.mutable_picture()->set_stamp_ns(frame->stamp.time_since_epoch().count());
    wire::write(frame->left, reply.mutable_picture()->mutable_image());
    wire::write(frame->right, reply.mutable_picture()->mutable_right());
    return {};
  }
  return no_such_device();
}

}  // namespace

WorldHost::WorldHost(drivers::SharedDevices devices, HostParams params)
    : devices_(std::move(devices)), params_(params), gate_(devices_.robots.size()), robots_(devices_.robots.size()) {}

v1::EmulatorReply WorldHost::answer(std::uint64_t id) const {
  v1::EmulatorReply reply;
  reply.set_id(id);
  reply.set_now_ns(devices_.world->now().time_since_epoch().count());
  wire::set_error(*reply.mutable_error(), {});
  return reply;
}

Result<std::size_t> WorldHost::enter(const v1::EmulatorHello& hello) {
  if (hello.protocol() != drivers::kEmulatorProtocol) {
    return fail(Errc::kUnsupportedVersion, "the robot speaks protocol " + std::to_string(hello.protocol()) +
                                               ", the emulator " + std::to_string(drivers::kEmulatorProtocol) +
                                               "; use programs of one version");
  }
  if (hello.robot() >= robots_.size()) {
    return fail(Errc::kNotFound, "this world has " + std::to_string(robots_.size()) +
                                     " robots, counted from 0; there is no " + std::to_string(hello.robot()));
  }
  Robot& robot = robots_[hello.robot()];
  if (robot.instance && *robot.instance != hello.instance()) {
    return fail(Errc::kBusy, "another program is robot " + std::to_string(hello.robot()) +
                                 " of this world already; choose another with emulator.robot");
  }
  robot = {hello.instance(), 0};
  gate_.hold(hello.robot());
  return hello.robot();
}

v1::EmulatorReply WorldHost::welcome(std::uint64_t request_id) const {
  v1::EmulatorReply reply = answer(request_id);
  v1::EmulatorWelcome& welcome = *reply.mutable_welcome();
  welcome.set_world_id(params_.world_id);
  welcome.set_lockstep(params_.lockstep);
  welcome.set_speed(params_.speed);
  drivers::write(devices_.robots.front().stereo->geometry(), welcome.mutable_stereo());
  return reply;
}

void WorldHost::leave(std::size_t robot) {
  robots_[robot] = {};
  devices_.robots[robot].simulation->command({});
  gate_.let_go(robot);
}

std::optional<v1::EmulatorReply> WorldHost::handle(std::size_t robot, const v1::EmulatorRequest& request) {
  Status done;
  if (request.call_case() == v1::EmulatorRequest::kAdvanceNs) {
    done = advance(robot, request);
    if (done) {
      return std::nullopt;
    }
  }
  v1::EmulatorReply reply = answer(request.id());
  switch (request.call_case()) {
    case v1::EmulatorRequest::kAdvanceNs: break;
    case v1::EmulatorRequest::kHold: gate_.hold(robot); break;
    case v1::EmulatorRequest::kLetGo:
      devices_.robots[robot].simulation->command({});  // nobody watches its time-out meanwhile
      gate_.let_go(robot);
      break;
    default: done = serve(devices_.robots[robot], request, reply);
  }
  wire::set_error(*reply.mutable_error(), done);
  return reply;
}

Status WorldHost::advance(std::size_t robot, const v1::EmulatorRequest& request) {
  const Duration period(request.advance_ns());
  if (period <= Duration::zero() || period > kMaxTick) {
    return fail(Errc::kInvalidArgument, "a tick lasts more than 0 and at most 10 s");
  }
  devices_.robots[robot].base->before_advance(period);
  robots_[robot].advance_id = request.id();
  gate_.wait(robot, devices_.world->now() + period);
  return {};
}

Status WorldHost::serve(drivers::SimDevices& robot, const v1::EmulatorRequest& request, v1::EmulatorReply& reply) {
  switch (request.call_case()) {
    case v1::EmulatorRequest::kActivate: {
      drivers::Driver* device = device_of(robot, request.activate());
      return device != nullptr ? device->activate() : no_such_device();
    }
    case v1::EmulatorRequest::kDeactivate: {
      drivers::Driver* device = device_of(robot, request.deactivate());
      if (device == nullptr) {
        return no_such_device();
      }
      device->deactivate();
      return {};
    }
    case v1::EmulatorRequest::kRead: return read(robot, request.read(), reply);
    case v1::EmulatorRequest::kGrab: return grab(robot, request.grab(), reply);
    case v1::EmulatorRequest::kSetVelocity: {
      const Result<Twist2> velocity = wire::from_message<Twist2>(request.set_velocity());
      return velocity ? robot.base->set_velocity(*velocity, devices_.world->now())
                      : Status(tl::unexpected<Error>(velocity.error()));
    }
    case v1::EmulatorRequest::kSetMotors: return robot.base->set_motors(request.set_motors());
    default: return fail(Errc::kInvalidArgument, "the emulator does not know this request");
  }
}

std::optional<RobotTime> WorldHost::next() const { return gate_.next(); }

std::vector<std::pair<std::size_t, v1::EmulatorReply>> WorldHost::go_on(RobotTime to) {
  devices_.world->advance(to - devices_.world->now());
  gate_.reached(to);
  std::vector<std::pair<std::size_t, v1::EmulatorReply>> replies;
  replies.reserve(robots_.size());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (robots_[i].advance_id != 0 && !gate_.waiting(i)) {
      replies.emplace_back(i, answer(std::exchange(robots_[i].advance_id, 0)));
    }
  }
  return replies;
}

}  // namespace seeker::emulator
