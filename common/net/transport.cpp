#include "common/net/transport.hpp"

#include <utility>

#include "common/core/assert.hpp"
#include "common/net/tls_stream.hpp"

namespace seeker::net {

Transport::Transport(Socket socket) : plain_(std::move(socket)) {}

Transport::Transport(std::unique_ptr<TlsStream> tls, pki::Certificate peer)
    : tls_(std::move(tls)), peer_(std::make_shared<const pki::Certificate>(std::move(peer))) {}

Transport::Transport(Transport&& other) noexcept = default;
Transport& Transport::operator=(Transport&& other) noexcept = default;
Transport::~Transport() = default;

Transport::Socket& Transport::socket() { return tls_ ? tls_->stream.next_layer() : *plain_; }

// Not in the header: the analyser of clang takes a moved executor for a null one.
Transport::Socket::executor_type Transport::get_executor() { return socket().get_executor(); }

Transport::Socket Transport::take_socket() {
  SEEKER_ASSERT(plain_);
  return std::move(*plain_);
}

std::string peer_address(Transport& transport) {
  boost::system::error_code error;
  const auto peer = transport.socket().remote_endpoint(error);
  if (error) {
    return {};
  }
  const std::string host = peer.address().to_string();
  return (peer.address().is_v6() ? "[" + host + "]" : host) + ":" + std::to_string(peer.port());
}

}  // namespace seeker::net
