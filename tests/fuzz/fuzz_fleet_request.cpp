// What another robot, or the operator, may send to the main robot of a fleet: parsing within limits, then every value
// of a request. What is accepted must survive a round trip.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/core/assert.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/convert_fleet.hpp"
#include "common/wire/envelope.hpp"

namespace {

using namespace seeker;  // NOLINT: a fuzz target is one small program

template <class M, class T>
M to_fleet_message(const T& value) {
  M message;
  wire::write(value, &message);
  return message;
}

template <class T, class M>
void check(const M& message) {
  const Result<T> value = wire::from_message<T>(message);
  if (value) {
    const Result<T> again = wire::from_message<T>(to_fleet_message<M>(*value));
    SEEKER_ASSERT(again.has_value() && *again == *value);
  }
}

/// Angles of its sectors are brought into one turn, and travel as single precision: they may come out a little off.
void check_share(const v1::FleetShare& message) {
  const Result<api::FleetShare> value = wire::from_message<api::FleetShare>(message);
  if (value) {
    SEEKER_ASSERT(wire::from_message<api::FleetShare>(to_fleet_message<v1::FleetShare>(*value)).has_value());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  v1::FleetRequest request;
  if (!wire::parse_within_limits({reinterpret_cast<const char*>(data), size}, request)) {
    return 0;
  }
  check<api::FleetManifest>(request.announce());
  check<api::FleetChunk>(request.chunk());
  check<api::FleetDecision>(request.decide());
  check<api::FleetSeen>(request.seen());
  check_share(request.share());
  return 0;
}
