#include "server/drivers/link/line.hpp"

#include <utility>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>

#include "common/net/connect.hpp"
#include "server/drivers/link/serial_line.hpp"
#include "server/drivers/link/stream_line.hpp"

namespace seeker::drivers {
namespace {

using TcpLine = StreamLine<boost::asio::ip::tcp::socket>;

}  // namespace

void open_line(boost::asio::io_context& io, const LineAddress& address, Duration timeout,
               std::function<void(Result<std::unique_ptr<Line>>)> done) {
  if (address.serial()) {
    boost::asio::post(io, [&io, path = address.path, done = std::move(done)] { done(SerialLine::open(io, path)); });
    return;
  }
  net::async_connect(io, {address.host, address.port, timeout, std::nullopt},
                     [name = to_string(address), done = std::move(done)](Result<net::Transport> transport) {
                       if (!transport) {
                         done(fail(transport.error().code,
                                   "no device answers at " + name + "; check its power, its address and the network"));
                         return;
                       }
                       boost::system::error_code ignored;
                       transport->socket().set_option(boost::asio::ip::tcp::no_delay(true), ignored);
                       done(std::make_unique<TcpLine>(transport->take_socket(), name));
                     });
}

}  // namespace seeker::drivers
