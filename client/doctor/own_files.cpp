#include "client/doctor/own_files.hpp"

#include "common/net/tls_context.hpp"

namespace seeker::doctor {

OwnFiles look_at(const pki::BundleFiles& files, pki::CalendarTime now) {
  OwnFiles found;
  const auto context = net::TlsContext::make(files, net::TlsSide::kClient);
  if (!context) {
    found.usable = tl::unexpected<Error>(context.error());
    return found;
  }
  found.certificate = (*context)->own().facts();
  found.believed = (*context)->trust().check((*context)->own(), now);
  return found;
}

}  // namespace seeker::doctor
