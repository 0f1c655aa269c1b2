/// \file
/// Shuts out addresses whose handshakes keep failing.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>

#include <boost/asio/ip/address.hpp>

#include "common/net/link_security.hpp"
#include "common/wire/liveness.hpp"

namespace seeker::net {

/// Knows no sockets and no clock. An IPv6 address stands for its network of 64 bits, all of which one machine may use.
class AddressGuard {
 public:
  explicit AddressGuard(LockoutParams params) : params_(params) {}

  /// Whether a connection of the address may be accepted now.
  [[nodiscard]] bool admits(const boost::asio::ip::address& address, wire::WallTime now) const;
  /// Notes a failed handshake. True: the address is shut out from now on.
  bool failed(const boost::asio::ip::address& address, wire::WallTime now);
  /// Number of addresses that are remembered.
  [[nodiscard]] std::size_t known() const { return records_.size(); }

 private:
  struct Record {
    std::deque<wire::WallTime> failures;  ///< the newest, at most `failures` of them
    std::optional<wire::WallTime> until;  ///< it is shut out
    wire::WallTime touched;
  };
  void make_room();

  LockoutParams params_;
  std::map<boost::asio::ip::address, Record> records_;
};

}  // namespace seeker::net
