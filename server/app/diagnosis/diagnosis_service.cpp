#include "server/app/diagnosis/diagnosis_service.hpp"

#include <utility>

#include "server/app/diagnosis/host_findings.hpp"

namespace seeker::app {
namespace {

/// Each takes some milliseconds.
constexpr std::size_t kMaxWaiting = 16;

}  // namespace

DiagnosisService::DiagnosisService(HostSources sources)
    : sources_(std::move(sources)), worker_(kMaxWaiting, "diagnoses") {}

void DiagnosisService::ask(const api::Reply<std::vector<api::Finding>>& reply) {
  const Status posted = worker_.post([this, reply] { reply(judge(collect(sources_))); });
  if (!posted) {
    reply(tl::unexpected<Error>(posted.error()));
  }
}

}  // namespace seeker::app
