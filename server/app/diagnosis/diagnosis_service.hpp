/// \file
/// The robot's diagnosis of its machine, made on a thread of its own: no tick waits for a disk, and a loop that is
/// stuck does not keep it back.
#pragma once

#include <vector>

#include "common/api/robot_api.hpp"
#include "server/app/diagnosis/host_facts.hpp"
#include "server/app/runtime/disk_worker.hpp"

namespace seeker::app {

class DiagnosisService {
 public:
  /// What `sources` calls must outlive this.
  explicit DiagnosisService(HostSources sources);

  /// Looks and judges; from any thread, the reply comes on the service's. kBusy: too many ask.
  void ask(const api::Reply<std::vector<api::Finding>>& reply);

 private:
  HostSources sources_;
  DiskWorker worker_;
};

}  // namespace seeker::app
