#include "tests/support/net/chaos_proxy.hpp"

#include <atomic>
#include <set>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include "tests/support/net/chaos_pair.hpp"

namespace seeker::testing {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

}  // namespace

/// All but the constructor runs on the thread.
class ChaosProxy::Impl {
 public:
  Impl(std::uint16_t server_port, std::uint64_t seed)
      : io_(1),
        acceptor_(io_, {asio::ip::address_v4::loopback(), 0}),
        hold_(io_),
        server_port_(server_port),
        port_(acceptor_.local_endpoint().port()),
        rng_(seed) {
    accept();
    thread_ = std::thread([this] { io_.run(); });
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    asio::post(io_, [this] {
      error_code ignored;
      acceptor_.close(ignored);
      hold_.cancel();
      held_.reset();
      cut();
    });
    thread_.join();
  }

  void cut() {
    for (const auto& pair : snapshot()) {
      pair->close();
    }
  }
  void impair(const Impairment& impairment) {
    rules_ = impairment;
    for (const auto& pair : snapshot()) {
      pair->obey();
    }
  }

  asio::io_context io_;
  tcp::acceptor acceptor_;
  asio::steady_timer hold_;
  std::uint16_t server_port_;
  std::uint16_t port_;
  Rng rng_;
  Impairment rules_;
  std::optional<tcp::socket> held_;  ///< waits for another one to be served
  std::set<std::shared_ptr<ChaosPair>> pairs_;
  std::atomic<std::size_t> connections_{0};
  std::atomic<std::size_t> open_{0};
  std::size_t served_ = 0;
  std::thread thread_;

 private:
  [[nodiscard]] std::vector<std::shared_ptr<ChaosPair>> snapshot() const { return {pairs_.begin(), pairs_.end()}; }

  void accept() {
    acceptor_.async_accept([this](error_code error, tcp::socket socket) {
      if (error) {
        return;
      }
      ++connections_;
      receive(std::move(socket));
      accept();
    });
  }
  void receive(tcp::socket socket) {
    if (rng_.uniform() < rules_.drop) {
      return;  // closes it
    }
    if (!held_ && rng_.uniform() < rules_.reorder) {
      hold(std::move(socket));
      return;
    }
    serve(std::move(socket));
  }
  void hold(tcp::socket socket) {
    held_.emplace(std::move(socket));
    hold_.expires_after(rules_.hold);
    hold_.async_wait([this](error_code error) {
      if (!error) {
        serve_held();
      }
    });
  }
  void serve_held() {
    if (held_) {
      hold_.cancel();
      serve(std::move(*held_));
      held_.reset();
    }
  }
  void serve(tcp::socket socket) {
    const auto pair = std::make_shared<ChaosPair>(std::move(socket), io_, rules_, rng_, ++served_);
    pairs_.insert(pair);
    ++open_;
    // The server must have heard the newer one before the held one, whose bytes wait already, reaches it.
    pair->start(
        server_port_, [this] { serve_held(); },
        [this, key = pair.get()] {
          std::erase_if(pairs_, [key](const auto& one) { return one.get() == key; });
          --open_;
        });
  }
};

ChaosProxy::ChaosProxy(std::uint16_t server_port, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(server_port, seed)) {}
ChaosProxy::~ChaosProxy() = default;
std::uint16_t ChaosProxy::port() const { return impl_->port_; }
void ChaosProxy::impair(const Impairment& impairment) {
  asio::post(impl_->io_, [impl = impl_.get(), impairment] { impl->impair(impairment); });
}
void ChaosProxy::cut() {
  asio::post(impl_->io_, [impl = impl_.get()] { impl->cut(); });
}
std::size_t ChaosProxy::connections() const { return impl_->connections_; }
std::size_t ChaosProxy::open() const { return impl_->open_; }

}  // namespace seeker::testing
