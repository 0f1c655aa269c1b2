#include "common/net/tls_door.hpp"

#include <algorithm>
#include <utility>

#include "common/log/log.hpp"

namespace seeker::net {
namespace {

constexpr Duration kLogPeriod = std::chrono::seconds(1);

}  // namespace

TlsDoor::TlsDoor(boost::asio::io_context& io, std::string_view part, const LinkSecurity& security, TlsKeeper keeper,
                 Handlers handlers)
    : part_(part),
      security_(security),
      keeper_(std::move(keeper)),
      handlers_(std::move(handlers)),
      guard_(security.lockout),
      refusals_(kLogPeriod),
      timer_(io) {}

void TlsDoor::start() { check_later(); }

void TlsDoor::receive(Transport::Socket socket) {
  boost::system::error_code gone;
  const boost::asio::ip::address address = socket.remote_endpoint(gone).address();
  if (gone) {
    return;
  }
  if (!guard_.admits(address, wall_now())) {
    write_refusals(part_,
                   refusals_.note(address.to_string() + " is shut out after too many failed handshakes", wall_now()));
    return;  // closes it
  }
  make_room();
  const auto acceptance = std::make_shared<TlsAcceptance>(std::move(socket), keeper_.context(), security_.handshake);
  waiting_.push_back(acceptance);
  acceptance->start({[this, address](Result<Transport> result) { on_result(address, std::move(result)); },
                     [this](const std::shared_ptr<TlsAcceptance>& gone_one) { waiting_.remove(gone_one); }});
}

void TlsDoor::make_room() {
  while (!waiting_.empty() && waiting_.size() >= security_.handshake.in_progress) {
    const std::shared_ptr<TlsAcceptance> oldest = waiting_.front();
    waiting_.pop_front();
    oldest->close();
    if (!oldest->refused()) {
      refused(oldest->address(), "it made room for another connection");
    }
  }
}

void TlsDoor::on_result(const boost::asio::ip::address& address, Result<Transport> result) {
  if (closed_) {
    return;
  }
  if (!result) {
    refused(address, result.error().message);
    return;
  }
  // The handshake may have begun before the files changed.
  const Status believed = keeper_.context().trust().check(*result->peer(), std::chrono::system_clock::now());
  if (!believed) {
    refused(address, believed.error().message);
    return;  // closes it
  }
  handlers_.on_transport(std::move(*result));
}

void TlsDoor::refused(const boost::asio::ip::address& address, const std::string& why) {
  const bool shut_out = guard_.failed(address, wall_now());
  write_refusals(part_, refusals_.note(address.to_string() + ": " + why, wall_now()));
  if (shut_out) {
    log::warning(part_, address.to_string() + " is shut out for " +
                            std::to_string(to_seconds(security_.lockout.duration)) + " s after " +
                            std::to_string(security_.lockout.failures) + " failed handshakes");
  }
}

void TlsDoor::check_later() {
  timer_.expires_after(security_.check_period);
  timer_.async_wait([this](boost::system::error_code error) {
    if (!error && !closed_) {
      check();
      check_later();
    }
  });
}

void TlsDoor::check() {
  const std::optional<Error> before = keeper_.problem();
  const bool renewed = keeper_.refresh();
  if (renewed) {
    log::info(part_, "certificates were read again; that of '" + keeper_.context().own().facts().name +
                         "' is valid until " + pki::date_text(keeper_.context().own().facts().not_after));
  } else if (keeper_.problem() && keeper_.problem() != before) {
    log::error(part_, "the former certificates stay in use: " + keeper_.problem()->message);
  }
  write_refusals(part_, refusals_.take(wall_now()));
  if (handlers_.on_check) {
    handlers_.on_check(renewed);
  }
}

void TlsDoor::close() {
  closed_ = true;
  timer_.cancel();
  for (const auto& acceptance : std::exchange(waiting_, {})) {
    acceptance->close();
  }
}

}  // namespace seeker::net
