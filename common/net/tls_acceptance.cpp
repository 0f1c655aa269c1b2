#include "common/net/tls_acceptance.hpp"

#include <utility>

#include "common/net/tls_error.hpp"
#include "common/net/tls_stream.hpp"

namespace seeker::net {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

asio::ip::address address_of(const Transport::Socket& socket) {
  error_code gone;
  return socket.remote_endpoint(gone).address();
}

}  // namespace

TlsAcceptance::TlsAcceptance(Transport::Socket socket, const TlsContext& context, HandshakeLimits limits)
    : limits_(limits), address_(address_of(socket)), timer_(socket.get_executor()) {
  SSL* session = context.new_session();
  if (session != nullptr) {
    tls_ = std::make_unique<TlsStream>(std::move(socket), session);
  }
}

TlsAcceptance::~TlsAcceptance() = default;

void TlsAcceptance::start(Handlers handlers) {
  handlers_ = std::move(handlers);
  if (!tls_) {
    refuse({Errc::kInternal, "out of memory"});
    return;
  }
  timer_.expires_after(limits_.timeout);
  timer_.async_wait([self = shared_from_this()](error_code error) {
    if (!error && !self->refused_) {
      self->refused_ = true;
      if (const auto on_result = std::exchange(self->handlers_.on_result, nullptr)) {
        on_result(fail(Errc::kTimeout, "it did not finish the handshake in time"));
      }
      self->end();
    }
  });
  tls_->stream.async_handshake(asio::ssl::stream_base::server,
                               [self = shared_from_this()](error_code error) { self->on_handshake(error); });
}

void TlsAcceptance::on_handshake(const error_code& error) {
  if (!handlers_.on_result) {
    return;
  }
  if (is_not_tls(error)) {
    send_alert();
  }
  if (error) {
    refuse({Errc::kRefused, failed_client(error, SSL_get_verify_result(tls_->stream.native_handle()))});
    return;
  }
  Result<Transport> known = identify();
  if (!known) {
    refuse(known.error());
    return;
  }
  timer_.cancel();
  const auto on_result = std::exchange(handlers_.on_result, nullptr);
  const auto on_gone = std::exchange(handlers_.on_gone, nullptr);
  on_result(std::move(known));
  on_gone(shared_from_this());
}

Result<Transport> TlsAcceptance::identify() {
  X509* shown = SSL_get1_peer_certificate(tls_->stream.native_handle());
  if (shown == nullptr) {
    return fail(Errc::kRefused, "it has shown no certificate");
  }
  pki::Certificate certificate(shown);
  if (!certificate.facts().role || !pki::is_certificate_name(certificate.facts().name)) {
    return fail(Errc::kRefused, "its certificate has no name or role as 'seeker pki issue' writes them");
  }
  return Transport(std::move(tls_), std::move(certificate));
}

void TlsAcceptance::send_alert() {
  // A fatal alert, protocol_version (RFC 8446, section 6).
  static constexpr std::array<unsigned char, 7> kProtocolVersion{0x15, 0x03, 0x03, 0x00, 0x02, 0x02, 0x46};
  error_code ignored;
  // The first bytes on this connection: the system takes them at once.
  tls_->stream.next_layer().non_blocking(true, ignored);
  tls_->stream.next_layer().write_some(asio::buffer(kProtocolVersion), ignored);
}

void TlsAcceptance::refuse(const Error& why) {
  refused_ = true;
  const auto self = shared_from_this();
  if (const auto on_result = std::exchange(handlers_.on_result, nullptr)) {
    on_result(tl::unexpected<Error>(why));
  }
  if (!tls_ || !handlers_.on_gone) {
    end();
    return;
  }
  error_code ignored;
  tls_->stream.next_layer().shutdown(Transport::Socket::shutdown_send, ignored);
  timer_.expires_after(limits_.linger);
  timer_.async_wait([self](error_code error) {
    if (!error) {
      self->end();
    }
  });
  discard();
}

void TlsAcceptance::discard() {
  tls_->stream.next_layer().async_read_some(asio::buffer(unread_),
                                            [self = shared_from_this()](error_code error, std::size_t) {
                                              if (error) {
                                                self->end();
                                              } else {
                                                self->discard();
                                              }
                                            });
}

void TlsAcceptance::end() {
  const auto on_gone = std::exchange(handlers_.on_gone, nullptr);
  close();
  if (on_gone) {
    on_gone(shared_from_this());
  }
}

void TlsAcceptance::close() {
  handlers_ = {};
  timer_.cancel();
  if (tls_) {
    error_code ignored;
    tls_->stream.next_layer().close(ignored);
  }
}

}  // namespace seeker::net
