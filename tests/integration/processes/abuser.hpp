/// \file
/// Those who torment a robot's port, with certificates or without.
#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/core/rng.hpp"
#include "tests/integration/net/recorded_bytes.hpp"
#include "tests/integration/net/tls_fixture.hpp"
#include "tests/support/random_bytes.hpp"

namespace seeker::testing {

/// A frame with this body.
inline std::string frame_around(const std::string& body) {
  const auto length = static_cast<std::uint32_t>(body.size());
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) {
    out += static_cast<char>((length >> static_cast<unsigned>(shift)) & 0xFFU);
  }
  return out + body;
}

/// Bytes of which each kind must end a session at once.
class BadBytes {
 public:
  static constexpr std::size_t kKinds = 6;

  explicit BadBytes(std::uint64_t seed) : rng_(seed) {
    pb::Envelope hello;
    hello.mutable_hello()->set_client_name("truncated");
    hello_ = hello.SerializeAsString();
    pb::Envelope early;
    early.mutable_request()->mutable_header()->set_request_id(1);
    early.mutable_request()->mutable_stop();
    early_ = early.SerializeAsString();
  }
  [[nodiscard]] std::string next() {
    constexpr std::size_t kDepth = 100'000;
    constexpr char kStartOfGroup = '\x0b';
    switch (number_++ % kKinds) {
      case 0: return frame_around(garbage());
      case 1: return std::string("\x01\x00\x00\x01", 4) + garbage();  // 16 MiB and one
      case 2: return frame_around(std::string(kDepth, kStartOfGroup));
      case 3: return frame_around(hello_.substr(0, hello_.size() - 3));
      case 4: return frame_around("");
      default: return frame_around(early_);  // before hello
    }
  }

 private:
  [[nodiscard]] std::string garbage() {
    const std::vector<std::uint8_t> bytes = random_bytes(rng_, 200);
    return {bytes.begin(), bytes.end()};
  }

  Rng rng_;
  std::size_t number_ = 0;
  std::string hello_;
  std::string early_;
};

/// They are other machines: what they compute is not to be taken from the robot's processor.
inline void be_another_machine() {
  constexpr int kLower = 5;
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kLower);
}

/// Connections that say a byte now and then and never say anything.
class SlowLoris {
 public:
  SlowLoris(std::uint16_t port, std::size_t connections) : port_(port), connections_(connections) {}
  /// Each says one byte more; those that were closed come again.
  void go_on() {
    while (held_.size() < connections_) {
      held_.push_back(std::make_unique<RawClient>(port_));
      held_.back()->send_bytes(std::string("\0\0", 2));
    }
    held_.remove_if([](const std::unique_ptr<RawClient>& one) { return !one->send_byte('\x01'); });
  }

 private:
  std::uint16_t port_;
  std::size_t connections_;
  std::list<std::unique_ptr<RawClient>> held_;
};

/// Sends the bytes to a plain port, and waits for the end.
inline void offend(std::uint16_t port, const std::string& bytes) {
  RawClient client(port);
  client.send_bytes(bytes);
  while (client.receive()) {
  }
}

/// Shakes hands and says hello as an observer, then sends the bytes, and waits for the end.
inline void offend_inside(std::uint16_t port, const pki::BundleFiles& bundle, const std::string& bytes) {
  TlsPeer peer(port, bundle);
  pb::Envelope hello;
  hello.mutable_hello()->set_protocol_major(api::kProtocolMajor);
  hello.mutable_hello()->set_client_name("olga/offender");
  hello.mutable_hello()->set_role(pb::ROLE_OBSERVER);
  boost::system::error_code ignored;
  boost::asio::write(peer.stream(), boost::asio::buffer(frame_around(hello.SerializeAsString()) + bytes), ignored);
  static_cast<void>(peer.end());
}

}  // namespace seeker::testing
