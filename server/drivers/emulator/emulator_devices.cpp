#include "server/drivers/emulator/emulator_devices.hpp"

#include <utility>

#include "common/wire/convert.hpp"
#include "server/drivers/emulator/emulator_wire.hpp"

namespace seeker::drivers {
namespace {

using Reply = Result<v1::EmulatorReply>;

/// The lifecycle of one device on the other side of a link.
class Remote {
 public:
  Remote(std::shared_ptr<EmulatorLink> link, v1::EmulatorDevice device) : link_(std::move(link)), device_(device) {}

  [[nodiscard]] Status activate() const {
    v1::EmulatorRequest request;
    request.set_activate(device_);
    return done(link_->call(std::move(request)));
  }
  void deactivate() const {
    v1::EmulatorRequest request;
    request.set_deactivate(device_);
    // A world that cannot be reached has stopped the robot by itself.
    static_cast<void>(link_->call(std::move(request)));
  }
  [[nodiscard]] Reply read() const {
    v1::EmulatorRequest request;
    request.set_read(device_);
    return link_->call(std::move(request));
  }
  [[nodiscard]] Reply grab() const {
    v1::EmulatorRequest request;
    request.set_grab(device_);
    Reply reply = link_->call(std::move(request));
    if (reply && !reply->has_picture()) {
      return fail(Errc::kInternal, "the emulator sent no picture");
    }
    return reply;
  }
  [[nodiscard]] EmulatorLink& link() const { return *link_; }
  [[nodiscard]] static Status done(const Reply& reply) {
    return reply ? Status() : Status(tl::unexpected<Error>(reply.error()));
  }

 private:
  std::shared_ptr<EmulatorLink> link_;
  v1::EmulatorDevice device_;
};

/// `has` and `get` are those of the result that the reply must hold, where it holds any.
template <class Sample, class Has, class Get>
Result<std::optional<Sample>> sample_of(const Reply& reply, Has has, Get get) {
  if (!reply) {
    return tl::unexpected<Error>(reply.error());
  }
  if (!((*reply).*has)()) {
    return std::optional<Sample>();
  }
  wire::Check check;
  Sample sample;
  using wire::read;
  read(((*reply).*get)(), sample, check);
  if (!check.ok()) {
    return tl::unexpected<Error>(check.status().error());
  }
  return std::optional<Sample>(std::move(sample));
}

class EmulatorBase final : public BaseDriver {
 public:
  explicit EmulatorBase(std::shared_ptr<EmulatorLink> link) : remote_(std::move(link), v1::EMULATOR_DEVICE_BASE) {}
  [[nodiscard]] Status activate() override { return remote_.activate(); }
  void deactivate() override { remote_.deactivate(); }
  [[nodiscard]] Result<std::optional<OdometrySample>> read() override {
    return sample_of<OdometrySample>(remote_.read(), &v1::EmulatorReply::has_odometry, &v1::EmulatorReply::odometry);
  }
  [[nodiscard]] Status set_velocity(const Twist2& velocity, RobotTime /*now*/) override {
    v1::EmulatorRequest request;
    wire::write(velocity, request.mutable_set_velocity());
    return Remote::done(remote_.link().call(std::move(request)));
  }
  [[nodiscard]] Status set_motors(bool enabled) override {
    v1::EmulatorRequest request;
    request.set_set_motors(enabled);
    return Remote::done(remote_.link().call(std::move(request)));
  }

 private:
  Remote remote_;
};

class EmulatorLidar final : public LidarDriver {
 public:
  explicit EmulatorLidar(std::shared_ptr<EmulatorLink> link) : remote_(std::move(link), v1::EMULATOR_DEVICE_LIDAR) {}
  [[nodiscard]] Status activate() override { return remote_.activate(); }
  void deactivate() override { remote_.deactivate(); }
  [[nodiscard]] Result<std::optional<LaserScan>> read() override {
    return sample_of<LaserScan>(remote_.read(), &v1::EmulatorReply::has_scan, &v1::EmulatorReply::scan);
  }

 private:
  Remote remote_;
};

class EmulatorSonar final : public SonarDriver {
 public:
  explicit EmulatorSonar(std::shared_ptr<EmulatorLink> link) : remote_(std::move(link), v1::EMULATOR_DEVICE_SONAR) {}
  [[nodiscard]] Status activate() override { return remote_.activate(); }
  void deactivate() override { remote_.deactivate(); }
  [[nodiscard]] Result<std::optional<SonarScan>> read() override {
    return sample_of<SonarScan>(remote_.read(), &v1::EmulatorReply::has_sonar, &v1::EmulatorReply::sonar);
  }

 private:
  Remote remote_;
};

class EmulatorCamera final : public CameraDriver {
 public:
  explicit EmulatorCamera(std::shared_ptr<EmulatorLink> link) : remote_(std::move(link), v1::EMULATOR_DEVICE_CAMERA) {}
  [[nodiscard]] Status activate() override { return remote_.activate(); }
  void deactivate() override { remote_.deactivate(); }
  [[nodiscard]] Result<CameraFrame> grab() override {
    const Reply reply = remote_.grab();
    if (!reply) {
      return tl::unexpected<Error>(reply.error());
    }
    Result<Image> image = wire::from_message<Image>(reply->picture().image());
    if (!image) {
      return tl::unexpected<Error>(image.error());
    }
    return CameraFrame{RobotTime(Duration(reply->picture().stamp_ns())), std::move(*image)};
  }

 private:
  Remote remote_;
};

class EmulatorStereo final : public StereoDriver {
 public:
  explicit EmulatorStereo(std::shared_ptr<EmulatorLink> link) : remote_(std::move(link), v1::EMULATOR_DEVICE_STEREO) {}
  [[nodiscard]] Status activate() override { return remote_.activate(); }
  void deactivate() override { remote_.deactivate(); }
  [[nodiscard]] Result<StereoFrame> grab() override {
    const Reply reply = remote_.grab();
    if (!reply) {
      return tl::unexpected<Error>(reply.error());
    }
    Result<Image> left = wire::from_message<Image>(reply->picture().image());
    Result<Image> right = wire::from_message<Image>(reply->picture().right());
    if (!left || !right) {
      return tl::unexpected<Error>(left ? right.error() : left.error());
    }
    return StereoFrame{RobotTime(Duration(reply->picture().stamp_ns())), std::move(*left), std::move(*right)};
  }
  [[nodiscard]] const StereoGeometry& geometry() const override { return remote_.link().stereo(); }

 private:
  Remote remote_;
};

class EmulatorClock final : public Clock {
 public:
  explicit EmulatorClock(std::shared_ptr<EmulatorLink> link) : link_(std::move(link)) {}
  [[nodiscard]] RobotTime now() const override { return link_->now(); }
  [[nodiscard]] Status advance(Duration period) override {
    if (period <= Duration::zero()) {
      return fail(Errc::kInvalidArgument, "the clock advances by a period above 0");
    }
    link_->advance(period);
    return {};
  }
  [[nodiscard]] Result<bool> await(Duration limit) override { return link_->await(limit); }
  [[nodiscard]] Status reachable() const override { return link_->reachable(); }
  void hold() override {
    v1::EmulatorRequest request;
    request.set_hold(true);
    // Without a link there is no world to hold: the devices report the lost link.
    static_cast<void>(link_->call(std::move(request)));
  }
  void let_go() override {
    v1::EmulatorRequest request;
    request.set_let_go(true);
    static_cast<void>(link_->call(std::move(request)));
  }
  [[nodiscard]] bool lockstep() const override { return link_->lockstep(); }
  [[nodiscard]] double speed() const override { return link_->speed(); }

 private:
  std::shared_ptr<EmulatorLink> link_;
};

}  // namespace

EmulatorDevices make_emulator_devices(const std::shared_ptr<EmulatorLink>& link) {
  return {std::make_unique<EmulatorClock>(link),  std::make_unique<EmulatorBase>(link),
          std::make_unique<EmulatorLidar>(link),  std::make_unique<EmulatorSonar>(link),
          std::make_unique<EmulatorCamera>(link), std::make_unique<EmulatorStereo>(link)};
}

}  // namespace seeker::drivers
