#include "server/drivers/rplidar/enquiry.hpp"

namespace seeker::drivers {

void Enquiry::begin(const rplidar::Request& request, RobotTime now) {
  request_ = request;
  answer_.reset();
  left_ = tries_ - 1;
  extended_ = false;
  deadline_ = now + timeout_;
}

std::optional<rplidar::AnswerValue> Enquiry::confirm(const rplidar::AnswerValue& answer) {
  if (answer_ == answer) {
    return answer;
  }
  answer_ = answer;
  if (!extended_) {
    extended_ = true;
    left_ += tries_;
  }
  return std::nullopt;
}

bool Enquiry::ask_again(RobotTime now) {
  if (left_ == 0) {
    return false;
  }
  --left_;
  deadline_ = now + timeout_;
  return true;
}

}  // namespace seeker::drivers
