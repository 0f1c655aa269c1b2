#include "tests/support/net/chaos_proxy.hpp"

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>

namespace seeker::testing {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::size_t kBufferBytes = 64UL * 1024;

struct Rules {
  bool stalled = false;
  bool refusing = false;
  std::size_t trickle = 0;
};

/// Two sockets and the bytes between them.
class Pair : public std::enable_shared_from_this<Pair> {
 public:
  Pair(tcp::socket client, asio::io_context& io, const Rules& rules)
      : client_(std::move(client)), server_(io), rules_(rules) {}

  void start(std::uint16_t port, std::function<void()> on_end) {
    on_end_ = std::move(on_end);
    server_.async_connect({asio::ip::address_v4::loopback(), port}, [self = shared_from_this()](error_code error) {
      if (error) {
        self->close();
        return;
      }
      // Else it would wait for acknowledgements that the receiver holds back for 40 ms.
      error_code ignored;
      self->client_.set_option(tcp::no_delay(true), ignored);
      self->server_.set_option(tcp::no_delay(true), ignored);
      self->pump(0);
      self->pump(1);
    });
  }
  void close() {
    error_code ignored;
    client_.close(ignored);
    server_.close(ignored);
    if (const auto on_end = std::exchange(on_end_, nullptr)) {
      on_end();
    }
  }
  void resume() {
    for (std::size_t way = 0; way < 2; ++way) {
      if (std::exchange(waiting_[way], false)) {
        pump(way);
      }
    }
  }

 private:
  /// way 0: client to server.
  void pump(std::size_t way) {
    if (rules_.stalled) {
      waiting_[way] = true;
      return;
    }
    tcp::socket& from = way == 0 ? client_ : server_;
    const std::size_t most = rules_.trickle == 0 ? kBufferBytes : std::min(rules_.trickle, kBufferBytes);
    from.async_read_some(
        asio::buffer(buffers_[way].data(), most),
        [self = shared_from_this(), way](error_code error, std::size_t n) { self->pass(way, error, n); });
  }
  void pass(std::size_t way, error_code error, std::size_t n) {
    if (error) {
      close();
      return;
    }
    tcp::socket& to = way == 0 ? server_ : client_;
    asio::async_write(to, asio::buffer(buffers_[way].data(), n),
                      [self = shared_from_this(), way](error_code failed, std::size_t) {
                        if (failed) {
                          self->close();
                        } else {
                          self->pump(way);
                        }
                      });
  }

  tcp::socket client_;
  tcp::socket server_;
  const Rules& rules_;
  std::function<void()> on_end_;
  std::vector<char> buffers_[2] = {std::vector<char>(kBufferBytes), std::vector<char>(kBufferBytes)};
  bool waiting_[2] = {false, false};
};

}  // namespace

class ChaosProxy::Impl {
 public:
  explicit Impl(std::uint16_t server_port)
      : io_(1),
        acceptor_(io_, {asio::ip::address_v4::loopback(), 0}),
        server_port_(server_port),
        port_(acceptor_.local_endpoint().port()) {
    accept();
    thread_ = std::thread([this] { io_.run(); });
  }
  ~Impl() {
    asio::post(io_, [this] {
      error_code ignored;
      acceptor_.close(ignored);
      cut();
    });
    thread_.join();
  }
  template <class F>
  void post(F&& f) {
    asio::post(io_, std::forward<F>(f));
  }
  void cut() {
    const std::vector<std::shared_ptr<Pair>> pairs(pairs_.begin(), pairs_.end());
    for (const auto& pair : pairs) {
      pair->close();
    }
  }
  void accept() {
    acceptor_.async_accept([this](error_code error, tcp::socket socket) {
      if (error) {
        return;
      }
      ++connections_;
      if (!rules_.refusing) {
        auto pair = std::make_shared<Pair>(std::move(socket), io_, rules_);
        pairs_.insert(pair);
        pair->start(server_port_, [this, key = pair.get()] {
          std::erase_if(pairs_, [key](const auto& one) { return one.get() == key; });
        });
      }
      accept();
    });
  }

  asio::io_context io_;
  tcp::acceptor acceptor_;
  std::uint16_t server_port_;
  std::uint16_t port_;
  Rules rules_;
  std::set<std::shared_ptr<Pair>> pairs_;
  std::atomic<std::size_t> connections_{0};
  std::thread thread_;
};

ChaosProxy::ChaosProxy(std::uint16_t server_port) : impl_(std::make_shared<Impl>(server_port)) {}
ChaosProxy::~ChaosProxy() = default;
std::uint16_t ChaosProxy::port() const { return impl_->port_; }
void ChaosProxy::cut() {
  impl_->post([impl = impl_.get()] { impl->cut(); });
}
void ChaosProxy::stall(bool on) {
  impl_->post([impl = impl_.get(), on] {
    impl->rules_.stalled = on;
    const std::vector<std::shared_ptr<Pair>> pairs(impl->pairs_.begin(), impl->pairs_.end());
    for (const auto& pair : pairs) {
      pair->resume();
    }
  });
}
void ChaosProxy::refuse(bool on) {
  impl_->post([impl = impl_.get(), on] { impl->rules_.refusing = on; });
}
void ChaosProxy::trickle(std::size_t bytes) {
  impl_->post([impl = impl_.get(), bytes] { impl->rules_.trickle = bytes; });
}
std::size_t ChaosProxy::connections() const { return impl_->connections_; }

}  // namespace seeker::testing
