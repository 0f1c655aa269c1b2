#include "tests/support/net/chaos_pair.hpp"

#include <algorithm>
#include <utility>

#include <boost/asio/write.hpp>

namespace seeker::testing {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::size_t kBufferBytes = 64UL * 1024;
/// What may be on its way at once: as much as a long line of the internet holds.
constexpr std::size_t kMostQueued = 1024UL * 1024;
/// A limited bandwidth passes what fits into this time at once.
constexpr double kSlice_s = 0.01;

}  // namespace

ChaosPair::ChaosPair(Socket client, asio::io_context& io, const Impairment& rules, Rng& rng, std::size_t number)
    : client_(std::move(client)), server_(io), number_(number), rules_(rules), rng_(rng), lanes_{Lane(io), Lane(io)} {
  for (Lane& lane : lanes_) {
    lane.buffer.resize(kBufferBytes);
  }
}

void ChaosPair::start(std::uint16_t server_port, std::function<void()> on_heard, std::function<void()> on_end) {
  on_heard_ = std::move(on_heard);
  on_end_ = std::move(on_end);
  server_.async_connect({asio::ip::address_v4::loopback(), server_port}, [self = shared_from_this()](error_code error) {
    if (error) {
      self->close();
      return;
    }
    error_code ignored;
    self->client_.set_option(tcp::no_delay(true), ignored);
    self->server_.set_option(tcp::no_delay(true), ignored);
    self->started_ = true;
    self->read(kToServer);
    self->read(kToClient);
  });
}

void ChaosPair::close() {
  error_code ignored;
  client_.close(ignored);
  server_.close(ignored);
  for (Lane& lane : lanes_) {
    lane.timer.cancel();
  }
  if (const auto on_end = std::exchange(on_end_, nullptr)) {
    on_end();
  }
}

void ChaosPair::obey() {
  passed_ = 0;
  for (const std::size_t way : {kToServer, kToClient}) {
    read(way);
    write(way);
  }
}

std::size_t ChaosPair::most_at_once() const {
  std::size_t most = kBufferBytes;
  if (rules_.piece > 0) {
    most = std::min(most, rules_.piece);
  }
  if (rules_.bytes_per_s > 0.0) {
    most = std::min(most, std::max<std::size_t>(1, static_cast<std::size_t>(rules_.bytes_per_s * kSlice_s)));
  }
  return most;
}

ChaosPair::Time ChaosPair::due_after_now(Lane& lane, std::size_t bytes) {
  const Time now = std::chrono::steady_clock::now();
  Time due = now + rules_.delay + seconds(to_seconds(rules_.jitter) * rng_.uniform());
  if (rules_.bytes_per_s > 0.0) {
    lane.line_free = std::max(lane.line_free, now) + seconds(static_cast<double>(bytes) / rules_.bytes_per_s);
    due += lane.line_free - now;
  }
  lane.last_due = std::max(lane.last_due, due);
  return lane.last_due;
}

std::optional<std::size_t> ChaosPair::budget() const {
  const auto& limit = rules_.cut_at ? rules_.cut_at : rules_.half_open_at;
  return limit ? std::optional<std::size_t>(*limit - std::min(*limit, passed_)) : std::nullopt;
}

void ChaosPair::read(std::size_t way) {
  Lane& lane = lanes_.at(way);
  if (!started_ || lane.reading || lane.ended || !from(way).is_open() || stalls() || lane.queued >= kMostQueued) {
    return;
  }
  lane.reading = true;
  from(way).async_read_some(asio::buffer(lane.buffer.data(), most_at_once()),
                            [self = shared_from_this(), way](error_code error, std::size_t bytes) {
                              self->lanes_.at(way).reading = false;
                              if (!self->on_end_ || self->lives_on_.value_or(way) != way) {
                                return;
                              }
                              if (error) {
                                self->lanes_.at(way).ended = true;
                                self->finish_if_drained(way);
                                return;
                              }
                              self->on_read(way, bytes);
                            });
}

void ChaosPair::on_read(std::size_t way, std::size_t bytes) {
  if (!lives_on_) {
    Lane& lane = lanes_.at(way);
    const auto end = lane.buffer.begin() + static_cast<std::ptrdiff_t>(bytes);
    lane.on_the_way.push_back({due_after_now(lane, bytes), {lane.buffer.begin(), end}});
    lane.queued += bytes;
    write(way);
  }
  read(way);
}

void ChaosPair::write(std::size_t way) {
  Lane& lane = lanes_.at(way);
  if (lane.writing || lane.on_the_way.empty() || stalls() || lives_on_) {
    return;
  }
  lane.writing = true;
  lane.timer.expires_at(lane.on_the_way.front().due);
  lane.timer.async_wait([self = shared_from_this(), way](error_code error) {
    self->lanes_.at(way).writing = false;
    if (!error && self->on_end_ && !self->stalls() && !self->lives_on_) {
      self->write_front(way);
    }
  });
}

void ChaosPair::write_front(std::size_t way) {
  Lane& lane = lanes_.at(way);
  lane.writing = true;
  const std::vector<char>& bytes = lane.on_the_way.front().bytes;
  const std::size_t passing = std::min(bytes.size(), budget().value_or(bytes.size()));
  passed_ += passing;
  asio::async_write(to(way), asio::buffer(bytes.data(), passing),
                    [self = shared_from_this(), way](error_code error, std::size_t written) {
                      self->lanes_.at(way).writing = false;
                      if (!self->on_end_ || self->lives_on_) {
                        return;
                      }
                      if (error) {
                        self->close();
                        return;
                      }
                      self->on_written(way, written);
                    });
}

void ChaosPair::on_written(std::size_t way, std::size_t bytes) {
  Lane& lane = lanes_.at(way);
  const std::size_t size = lane.on_the_way.front().bytes.size();
  if (bytes < size || budget() == std::size_t{0}) {
    break_now();
    return;
  }
  lane.queued -= size;
  lane.on_the_way.pop_front();
  if (const auto on_heard = way == kToServer ? std::exchange(on_heard_, nullptr) : nullptr) {
    on_heard();
  }
  finish_if_drained(way);
  write(way);
  read(way);
}

void ChaosPair::finish_if_drained(std::size_t way) {
  const Lane& lane = lanes_.at(way);
  if (lane.ended && (lane.on_the_way.empty() || lives_on_ == way)) {
    close();
  }
}

void ChaosPair::break_now() {
  if (rules_.half_open_at && !rules_.cut_at) {
    become_half_open();
  } else {
    close();
  }
}

void ChaosPair::become_half_open() {
  const bool server_gone = rng_.below(2) == 0;
  lives_on_ = server_gone ? kToServer : kToClient;
  error_code ignored;
  to(*lives_on_).close(ignored);
  for (Lane& lane : lanes_) {
    lane.timer.cancel();
  }
  read(*lives_on_);
}

}  // namespace seeker::testing
