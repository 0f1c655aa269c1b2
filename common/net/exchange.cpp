#include "common/net/exchange.hpp"

#include <utility>

#include "common/core/assert.hpp"

namespace seeker::net {

Result<std::unique_ptr<Exchange>> Exchange::connect(Target target) {
  std::unique_ptr<Exchange> exchange(new Exchange());
  std::optional<Result<Transport>> transport;
  async_connect(exchange->io_, std::move(target),
                [&transport](Result<Transport> result) { transport.emplace(std::move(result)); });
  exchange->io_.run();  // until the attempt has ended, within its time
  SEEKER_ASSERT(transport);
  if (!*transport) {
    return tl::unexpected<Error>(transport->error());
  }
  exchange->io_.restart();
  exchange->start(std::move(**transport));
  return exchange;
}

Exchange::~Exchange() {
  if (connection_) {
    connection_->close();
    io_.restart();
    io_.poll();
  }
}

void Exchange::start(Transport transport) {
  connection_ = std::make_shared<Connection>(std::move(transport), ConnectionParams{});
  Connection::Handlers handlers;
  handlers.on_frame = [this](std::string_view payload) { reply_ = std::string(payload); };
  handlers.next_frame = [this] { return std::exchange(request_, std::nullopt); };
  handlers.on_end = [this](const Error& error) { broken_ = error; };
  connection_->start(std::move(handlers));
}

Result<std::string> Exchange::ask(std::string payload, Duration timeout) {
  if (payload.size() > wire::kMaxFrameBytes) {
    return fail(Errc::kTooLarge, "the request does not fit into one frame");
  }
  reply_.reset();
  request_ = wire::make_frame(std::move(payload));
  connection_->wake();
  const wire::WallTime end = wall_now() + timeout;
  while (!reply_ && !broken_ && wall_now() < end) {
    io_.restart();
    io_.run_one_for(end - wall_now());
  }
  if (reply_) {
    return std::move(*reply_);
  }
  if (!broken_) {
    broken_ = Error{Errc::kTimeout, "no answer in " + std::to_string(to_seconds(timeout)) + " s; check the link"};
    connection_->close();
  }
  return tl::unexpected<Error>(*broken_);
}

}  // namespace seeker::net
