#include <algorithm>

#include "common/wire/convert.hpp"

namespace seeker::wire {
namespace {

void write_port(const api::ComponentPort& from, pb::ComponentPort* to) {
  to->set_name(clean_text(from.name, kMaxNameBytes));
  to->set_type(clean_text(from.type, kMaxNameBytes));
  to->set_output(from.output);
  for (std::size_t k = 0; k < std::min(from.connected.size(), kMaxPorts); ++k) {
    to->add_connected(clean_text(from.connected[k], kMaxPortNameBytes));
  }
  to->set_rate_hz(from.rate_hz);
  if (from.age) {
    to->set_age_ns(from.age->count());
  }
}

void read_port(const pb::ComponentPort& from, api::ComponentPort& to, Check& check) {
  to.name = check.text("name", from.name(), kMaxNameBytes);
  to.type = check.text("type", from.type(), kMaxNameBytes);
  to.output = from.output();
  if (check.count("connected", static_cast<std::size_t>(from.connected_size()), kMaxPorts)) {
    for (const std::string& port : from.connected()) {
      to.connected.push_back(check.text("connected", port, kMaxPortNameBytes));
    }
  }
  to.rate_hz = check.finite("rate_hz", from.rate_hz());
  if (from.has_age_ns()) {
    to.age = Duration(from.age_ns());
  }
}

void write_link(const api::ComponentLink& from, pb::ComponentLink* to) {
  to->set_bytes_in(from.bytes_in);
  to->set_bytes_out(from.bytes_out);
  to->set_packets_in(from.packets_in);
  to->set_packets_bad(from.packets_bad);
  to->set_bytes_skipped(from.bytes_skipped);
  to->set_connects(from.connects);
}

api::ComponentLink read_link(const pb::ComponentLink& from) {
  return {from.bytes_in(),    from.bytes_out(),     from.packets_in(),
          from.packets_bad(), from.bytes_skipped(), from.connects()};
}

}  // namespace

void write(const api::ComponentInfo& from, pb::ComponentInfo* to) {
  to->set_name(clean_text(from.name, kMaxNameBytes));
  to->set_kind(clean_text(from.kind, kMaxNameBytes));
  to->set_type(clean_text(from.type, kMaxNameBytes));
  to->set_state(static_cast<pb::ComponentState>(wire_enum(from.state)));
  to->set_rate_hz(from.rate_hz);
  to->set_last_error(clean_text(from.last_error));
  for (std::size_t k = 0; k < std::min(from.ports.size(), kMaxPorts); ++k) {
    write_port(from.ports[k], to->add_ports());
  }
  if (from.link) {
    write_link(*from.link, to->mutable_link());
  }
}

void read(const pb::ComponentInfo& from, api::ComponentInfo& to, Check& check) {
  to.name = check.text("name", from.name(), kMaxNameBytes);
  to.kind = check.text("kind", from.kind(), kMaxNameBytes);
  to.type = check.text("type", from.type(), kMaxNameBytes);
  check.enumerator("state", from.state(), api::ComponentState::kError, to.state);
  to.rate_hz = check.finite("rate_hz", from.rate_hz());
  to.last_error = check.text("last_error", from.last_error());
  to.link = from.has_link() ? std::optional(read_link(from.link())) : std::nullopt;
  const auto ports = static_cast<std::size_t>(from.ports_size());
  if (!check.count("ports", ports, kMaxPorts)) {
    return;
  }
  to.ports.resize(ports);
  for (std::size_t k = 0; k < ports; ++k) {
    const auto scope = check.in("ports", k);
    read_port(from.ports(static_cast<int>(k)), to.ports[k], check);
  }
}

void write(const api::ComponentSetting& from, pb::ComponentSetting* to) {
  to->set_key(clean_text(from.key, kMaxSettingKeyBytes));
  to->set_value(clean_text(from.value));
  to->set_path(clean_text(from.path, kMaxSettingKeyBytes));
  to->set_effect(static_cast<pb::SettingEffect>(wire_enum(from.effect)));
}

void read(const pb::ComponentSetting& from, api::ComponentSetting& to, Check& check) {
  to.key = check.text("key", from.key(), kMaxSettingKeyBytes);
  to.value = check.text("value", from.value());
  to.path = check.text("path", from.path(), kMaxSettingKeyBytes);
  check.enumerator("effect", from.effect(), api::SettingEffect::kRestart, to.effect);
}

}  // namespace seeker::wire
