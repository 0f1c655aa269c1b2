/// \file
/// The newest reading of each transducer of a base, which sends only new ones (protocols 1.6).
#pragma once

#include <array>
#include <optional>

#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "server/drivers/p2os/p2os_params.hpp"
#include "server/protocols/p2os/pioneer_model.hpp"
#include "server/protocols/p2os/sip.hpp"

namespace seeker::drivers {

class SonarRing {
 public:
  /// `params` must outlive it.
  explicit SonarRing(const P2osParams& params) : params_(params) {}

  /// A connection to a base of this model begins; earlier readings are forgotten.
  void connect(const p2os::PioneerModel& model);
  void add(const p2os::Sip& sip, RobotTime stamp);
  /// The ring if it has a new reading, with the stamp of the newest one. A transducer that has sent nothing for a while
  /// is left out, for nothing is known where it points.
  [[nodiscard]] std::optional<SonarScan> take();

 private:
  struct Echo {
    float range_m = kNoReturn;
    RobotTime stamp;
  };

  const P2osParams& params_;
  const p2os::PioneerModel* model_ = nullptr;
  std::array<std::optional<Echo>, 2 * p2os::kArraySonars> echoes_;
  RobotTime newest_;
  bool fresh_ = false;
};

}  // namespace seeker::drivers
