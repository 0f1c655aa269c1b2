#include "common/net/listen.hpp"

#include <utility>

#include "common/core/time.hpp"
#include "common/log/log.hpp"
#include "common/net/tls_door.hpp"

namespace seeker::net {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr Duration kAcceptPause = std::chrono::milliseconds(100);  ///< after one that failed

/// An unlocked door is said loudly.
LinkHealth health_at_start(std::string_view part, const std::string& address, const LinkSecurity& security) {
  LinkHealth health;
  health.address = address;
  health.tls = security.tls();
  health.insecure = !health.tls && !check_allowed(address, {});
  if (health.insecure) {
    log::warning(part, "INSECURE: everybody who reaches " + address +
                           " may command here, nothing is encrypted; make certificates with 'seeker pki'");
  }
  return health;
}

}  // namespace

Listener::Listener(asio::io_context& io, std::string_view part, Handlers handlers)
    : io_(io), part_(part), handlers_(std::move(handlers)), acceptor_(io), pause_(io) {}

Listener::~Listener() = default;

Result<std::uint16_t> Listener::open(const std::string& address, std::uint16_t port, const LinkSecurity& security) {
  error_code error;
  const auto interface = asio::ip::make_address(address, error);
  if (error) {
    return fail(Errc::kInvalidArgument, "'" + address + "' is not an IP address of this machine");
  }
  if (const Status allowed = check_allowed(address, security); !allowed) {
    return tl::unexpected<Error>(allowed.error());
  }
  health_ = health_at_start(part_, address, security);
  if (security.tls()) {
    Result<TlsKeeper> keeper = TlsKeeper::open(security.files);
    if (!keeper) {
      return tl::unexpected<Error>(keeper.error());
    }
    door_ = std::make_unique<TlsDoor>(io_, part_, security, std::move(*keeper),
                                      TlsDoor::Handlers{handlers_.on_transport, [this](bool renewed) {
                                                          renewed_ = renewed;
                                                          handlers_.on_check();
                                                        }});
  }
  const tcp::endpoint endpoint(interface, port);
  acceptor_.open(endpoint.protocol(), error);
  if (!error) {
    acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
  }
  if (!error) {
    acceptor_.bind(endpoint, error);
  }
  if (!error) {
    acceptor_.listen(asio::socket_base::max_listen_connections, error);
  }
  if (error) {
    return fail(Errc::kIo, "cannot listen on " + address + " port " + std::to_string(port) + ": " + error.message() +
                               "; stop what listens there or choose another port");
  }
  if (door_) {
    door_->start();
  }
  return acceptor_.local_endpoint().port();
}

void Listener::receive(Transport::Socket socket) {
  if (door_) {
    door_->receive(std::move(socket));
  } else {
    handlers_.on_transport(Transport(std::move(socket)));
  }
}

void Listener::accept() {
  acceptor_.async_accept([this](error_code error, tcp::socket socket) {
    if (closed_) {
      return;
    }
    if (!error) {
      receive(std::move(socket));
      accept();
      return;
    }
    log::warning(part_, "a connection could not be accepted: " + error.message());
    pause_.expires_after(kAcceptPause);
    pause_.async_wait([this](error_code ended) {
      if (!ended) {
        accept();
      }
    });
  });
}

void Listener::close() {
  closed_ = true;
  error_code ignored;
  acceptor_.close(ignored);
  pause_.cancel();
  if (door_) {
    door_->close();
  }
}

Status Listener::check(const pki::Certificate* peer) const {
  const pki::CalendarTime now = std::chrono::system_clock::now();
  // Verifying costs time: only what can have changed.
  const bool can_have_ended = door_ != nullptr && peer != nullptr && (renewed_ || peer->facts().not_after <= now);
  return can_have_ended ? door_->keeper().context().trust().check(*peer, now) : Status();
}

LinkHealth Listener::health() const {
  LinkHealth health = health_;
  if (door_) {
    const pki::CertificateFacts& own = door_->keeper().context().own().facts();
    health.name = own.name;
    health.expires = own.not_after;
    health.problem = door_->keeper().problem();
  }
  return health;
}

}  // namespace seeker::net
