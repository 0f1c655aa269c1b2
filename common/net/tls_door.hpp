/// \file
/// Lets connections in whose owners show a certificate.
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <string>
#include <string_view>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/net/address_guard.hpp"
#include "common/net/refusal_log.hpp"
#include "common/net/tls_acceptance.hpp"
#include "common/net/tls_keeper.hpp"

namespace seeker::net {

/// Runs on the io_context's single thread; outlives what runs there.
class TlsDoor {
 public:
  struct Handlers {
    std::function<void(Transport)> on_transport;
    /// Called after each look at the files, `check_period` apart; `renewed`: others are in use now.
    std::function<void(bool renewed)> on_check;
  };

  /// `part` names the component in the log; its characters outlive the door.
  TlsDoor(boost::asio::io_context& io, std::string_view part, const LinkSecurity& security, TlsKeeper keeper,
          Handlers handlers);

  /// Starts to look at the files.
  void start();
  void receive(Transport::Socket socket);
  void close();
  [[nodiscard]] const TlsKeeper& keeper() const { return keeper_; }

 private:
  void make_room();
  void on_result(const boost::asio::ip::address& address, Result<Transport> result);
  void refused(const boost::asio::ip::address& address, const std::string& why);
  void check_later();
  void check();

  std::string_view part_;
  LinkSecurity security_;
  TlsKeeper keeper_;
  Handlers handlers_;
  AddressGuard guard_;
  RefusalLog refusals_;
  boost::asio::steady_timer timer_;
  std::list<std::shared_ptr<TlsAcceptance>> waiting_;  ///< the longest waiting first
  bool closed_ = false;
};

}  // namespace seeker::net
