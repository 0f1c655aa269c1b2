#include "server/app/composition/watched_base.hpp"

namespace seeker::app {

Status WatchedBase::activate() {
  *history_ = {};  // a base that is opened again counts from zero
  return base_->activate();
}

Result<std::optional<drivers::OdometrySample>> WatchedBase::read() {
  Result<std::optional<drivers::OdometrySample>> sample = base_->read();
  if (sample && *sample && is_finite((*sample)->odom_T_base)) {
    history_->add(**sample);
  }
  return sample;
}

}  // namespace seeker::app
