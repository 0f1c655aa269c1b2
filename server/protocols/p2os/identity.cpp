#include "server/protocols/p2os/identity.hpp"

#include "server/protocols/p2os/field_reader.hpp"
#include "server/protocols/p2os/field_writer.hpp"

namespace seeker::p2os {

Result<Identity> read_identity(const Packet& packet) {
  FieldReader in(packet.data);
  const auto name = in.text();
  const auto class_name = in.text();
  const auto subclass = in.text();
  if (!name || !class_name || !subclass) {
    return fail(Errc::kCorrupt, "the base's answer to SYNC2 does not hold its name, class and subclass");
  }
  return Identity{*name, *class_name, *subclass};
}

Packet write_identity(const Identity& identity) {
  FieldWriter out;
  out.text(identity.name);
  out.text(identity.class_name);
  out.text(identity.subclass);
  return {static_cast<std::uint8_t>(PacketId::kSync2), out.take()};
}

}  // namespace seeker::p2os
