// What a peer may send: parsing within limits, then every validator. What is accepted must survive a round trip.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/core/assert.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/envelope.hpp"
#include "common/wire/server_session.hpp"

namespace {

using namespace seeker;  // NOLINT: a fuzz target is one small program

template <class T, class M>
void check(const M& message) {
  const Result<T> value = wire::from_message<T>(message);
  if (value) {
    const Result<T> again = wire::from_message<T>(wire::to_message<M>(*value));
    SEEKER_ASSERT(again.has_value() && *again == *value);
  }
}

void check_request(const v1::Request& request) {
  check<api::MissionRequest>(request.start_mission().mission());
  check<api::DriveCommand>(request.drive().command());
  for (const auto& topic : request.subscribe().topics()) {
    (void)wire::from_message<api::TopicRequest>(topic);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto envelope = wire::parse_envelope(bytes);
  if (envelope) {
    check_request(envelope->request());
    (void)wire::from_message<api::Update>(envelope->stream_update());
    check<api::RobotInfo>(envelope->hello_reply().robot());
    check<api::RobotStatus>(envelope->response().get_status().robot());
    check<api::GridReport>(envelope->response().get_grid().grid());
    for (const auto& component : envelope->response().list_components().components()) {
      check<api::ComponentInfo>(component);
    }
    for (const auto& setting : envelope->response().set_settings().settings()) {
      check<api::ComponentSetting>(setting);
    }
  }
  wire::ServerSession session({}, wire::WallTime{});
  (void)session.on_payload(bytes, wire::WallTime{}, RobotTime{});
  return 0;
}
