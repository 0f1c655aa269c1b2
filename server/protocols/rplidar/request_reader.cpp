#include "server/protocols/rplidar/request_reader.hpp"

#include <cstddef>
#include <utility>

namespace seeker::rplidar {
namespace {

constexpr std::size_t kPlainBytes = 2;     // start, command
constexpr std::size_t kWrappingBytes = 4;  // start, command, size, check

/// How a request at the start of some bytes stands.
struct Look {
  std::size_t bytes = 1;  ///< bytes to skip, or of the whole request; 0: more are needed
  std::optional<Request> request;
};

Look look_at(std::span<const std::uint8_t> bytes) {
  if (bytes[0] != kRequestStart) {
    return {};
  }
  if (bytes.size() < kPlainBytes) {
    return {.bytes = 0, .request = {}};
  }
  const auto command = static_cast<Command>(bytes[1]);
  if ((bytes[1] & kPayloadBit) == 0) {
    return {kPlainBytes, Request{command, {}}};
  }
  if (bytes[1] == kRequestStart) {
    return {};  // no command; the second of the two may be the start
  }
  if (bytes.size() < kPlainBytes + 1) {
    return {.bytes = 0, .request = {}};
  }
  const std::size_t payload = bytes[2];
  if (payload > kMaxRequestPayload) {
    return {};
  }
  const std::size_t whole = payload + kWrappingBytes;
  if (bytes.size() < whole) {
    return {.bytes = 0, .request = {}};
  }
  std::uint8_t check = 0;
  for (const std::uint8_t byte : bytes.first(whole)) {
    check ^= byte;
  }
  if (check != 0) {
    return {};
  }
  const auto data = bytes.subspan(kPlainBytes + 1, payload);
  return {whole, Request{command, {data.begin(), data.end()}}};
}

}  // namespace

std::vector<Request> RequestReader::read(std::span<const std::uint8_t> bytes) {
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  return take_whole();
}

std::vector<Request> RequestReader::give_up() {
  std::vector<Request> requests;
  while (!buffer_.empty()) {
    buffer_.erase(buffer_.begin());
    std::vector<Request> more = take_whole();
    requests.insert(requests.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }
  return requests;
}

std::vector<Request> RequestReader::take_whole() {
  std::vector<Request> requests;
  std::size_t at = 0;
  while (at < buffer_.size()) {
    Look look = look_at(std::span(buffer_).subspan(at));
    if (look.bytes == 0) {
      break;
    }
    at += look.bytes;
    if (look.request) {
      requests.push_back(std::move(*look.request));
    }
  }
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(at));
  return requests;
}

}  // namespace seeker::rplidar
