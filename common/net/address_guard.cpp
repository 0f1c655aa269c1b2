#include "common/net/address_guard.hpp"

#include <algorithm>

namespace seeker::net {
namespace {

namespace ip = boost::asio::ip;

/// The name under which an address is remembered.
ip::address network_of(const ip::address& address) {
  if (!address.is_v6()) {
    return address;
  }
  if (address.to_v6().is_v4_mapped()) {
    return ip::make_address_v4(ip::v4_mapped, address.to_v6());
  }
  constexpr std::size_t kNetworkBytes = 8;
  ip::address_v6::bytes_type bytes = address.to_v6().to_bytes();
  if (!address.is_loopback()) {
    std::fill(bytes.begin() + kNetworkBytes, bytes.end(), static_cast<unsigned char>(0));
  }
  return ip::address_v6(bytes);
}

}  // namespace

bool AddressGuard::admits(const ip::address& address, wire::WallTime now) const {
  const auto found = records_.find(network_of(address));
  return found == records_.end() || !found->second.until || now >= *found->second.until;
}

bool AddressGuard::failed(const ip::address& address, wire::WallTime now) {
  const ip::address network = network_of(address);
  if (network.is_loopback() && !params_.loopback) {
    return false;
  }
  if (records_.count(network) == 0) {
    make_room();
  }
  Record& record = records_[network];
  record.touched = now;
  record.failures.push_back(now);
  while (!record.failures.empty() && now - record.failures.front() > params_.within) {
    record.failures.pop_front();
  }
  if (record.failures.size() < params_.failures) {
    return false;
  }
  record.failures.clear();
  record.until = now + params_.duration;
  return true;
}

void AddressGuard::make_room() {
  if (records_.size() < std::max<std::size_t>(1, params_.addresses)) {
    return;
  }
  const auto older = [](const auto& a, const auto& b) { return a.second.touched < b.second.touched; };
  records_.erase(std::min_element(records_.begin(), records_.end(), older));
}

}  // namespace seeker::net
