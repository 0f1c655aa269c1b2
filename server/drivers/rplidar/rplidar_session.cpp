#include "server/drivers/rplidar/rplidar_session.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "common/core/assert.hpp"

namespace seeker::drivers {
namespace {

using rplidar::AnswerType;
using rplidar::Command;
using rplidar::Request;

constexpr RobotTime kNever = RobotTime::max();

}  // namespace

RplidarSession::RplidarSession(const RplidarParams& params)
    : params_(params), enquiry_(params.tries, params.answer_timeout), stream_(params) {
  SEEKER_ASSERT(validate(params));
}

void RplidarSession::open(RobotTime now) {
  found_ = {};
  warning_.reset();
  scan_.reset();
  baud_ = 0;
  bauds_tried_ = 0;
  resets_ = 0;
  restarts_ = 0;
  actions_.clear();
  act(SetBaud{params_.bauds[baud_]});
  if (params_.motor != RplidarMotor::kPwm) {
    act(SetDtr{false});  // the rotor of an A1 runs up while the questions are asked
  }
  stop(now);
}

void RplidarSession::act(LineAction action) {
  if (const auto* write = std::get_if<WriteBytes>(&action)) {
    statistics_.bytes_out += write->bytes.size();
  }
  actions_.push_back(std::move(action));
}

void RplidarSession::send(const Request& request) { act(WriteBytes{rplidar::encode(request)}); }

std::vector<LineAction> RplidarSession::take_actions() { return std::exchange(actions_, {}); }

void RplidarSession::stop(RobotTime now) {
  step_ = Step::kStopping;
  turning_ = false;
  send({Command::kStop, {}});
  pause_until_ = now + params_.stop_pause;
}

void RplidarSession::ask(Step step, const Request& request, AnswerType answer, RobotTime now) {
  step_ = step;
  expected_ = answer;
  enquiry_.begin(request, now);
  reader_.expect(answer);
  send(request);
}

void RplidarSession::repeat(RobotTime now) {
  if (!enquiry_.ask_again(now)) {
    return unanswered(now);
  }
  reader_.expect(expected_);  // half an answer must not swallow the next one
  send(enquiry_.request());
}

void RplidarSession::receive(std::span<const std::uint8_t> bytes, RobotTime now) {
  statistics_.bytes_in += bytes.size();
  const bool listens =
      step_ != Step::kClosed && step_ != Step::kStopping && step_ != Step::kBooting && step_ != Step::kFailed;
  if (!listens) {
    statistics_.bytes_skipped += bytes.size();
    return;
  }
  const std::vector<rplidar::Answer> answers = reader_.read(bytes);
  if (step_ == Step::kStarting && reader_.streaming()) {
    step_ = Step::kScanning;
    last_record_ = now;
    last_revolution_ = now;
  }
  const Step asked = step_;
  for (const rplidar::Answer& answer : answers) {
    if (step_ == Step::kScanning) {
      follow_scan(answer, now);
    } else if (step_ == asked) {  // what follows upon the answer that settled the question is a repetition
      answered(answer.value, now);
    }
  }
}

void RplidarSession::answered(const rplidar::AnswerValue& answer, RobotTime now) {
  if (const auto* conf = std::get_if<rplidar::ConfAnswer>(&answer); conf != nullptr && conf->type != asked_conf_) {
    return;  // a late answer to the question before
  }
  const std::optional<rplidar::AnswerValue> sure = enquiry_.confirm(answer);
  if (!sure) {
    return repeat(now);
  }
  if (step_ == Step::kInfo && std::holds_alternative<rplidar::DeviceInfo>(*sure)) {
    learn_info(std::get<rplidar::DeviceInfo>(*sure), now);
  } else if (step_ == Step::kHealth && std::holds_alternative<rplidar::Health>(*sure)) {
    learn_health(std::get<rplidar::Health>(*sure), now);
  } else if (step_ == Step::kSampleRate && std::holds_alternative<rplidar::SampleRate>(*sure)) {
    learn_rate(std::get<rplidar::SampleRate>(*sure), now);
  } else if (step_ == Step::kAccBoard && std::holds_alternative<rplidar::AccBoard>(*sure)) {
    found_.motor_by_pwm = std::get<rplidar::AccBoard>(*sure).controls_motor;
    choose_mode(now);
  } else if (const auto* conf = std::get_if<rplidar::ConfAnswer>(&*sure); conf == nullptr || !learn_conf(*conf, now)) {
    unanswered(now);
  }
}

void RplidarSession::follow_scan(const rplidar::Answer& answer, RobotTime now) {
  last_record_ = now;
  std::optional<LaserScan> turn = stream_.add(answer, now);
  if (!turn) {
    return;
  }
  if (!turning_) {
    turning_ = true;
    ++statistics_.connects;
  }
  restarts_ = 0;
  resets_ = 0;
  last_revolution_ = now;
  scan_ = std::move(turn);
}

void RplidarSession::pass(RobotTime now) {
  switch (step_) {
    case Step::kClosed:
    case Step::kFailed: return;
    case Step::kStopping:
    case Step::kBooting:
      if (now >= pause_until_) {
        act(DropInput{});
        ask(Step::kInfo, {Command::kGetInfo, {}}, AnswerType::kInfo, now);
      }
      return;
    case Step::kScanning:
      if (turning_ && now >= last_record_ + params_.scan_timeout) {
        restart("it fell silent", now);
      } else if (now >= last_revolution_ + params_.revolution_timeout) {
        restart("it completes no turn; see that its rotor runs freely", now);
      }
      return;
    default:
      if (now >= enquiry_.deadline()) {
        repeat(now);
      }
  }
}

void RplidarSession::restart(const std::string& reason, RobotTime now) {
  if (restarts_ >= params_.restarts) {
    return give_up(Errc::kLinkLost, "the RPLIDAR's scan was started " + std::to_string(restarts_ + 1) +
                                        " times in vain: " + reason + "; check its cable and power");
  }
  ++restarts_;
  stop(now);
}

void RplidarSession::give_up(Errc code, std::string message) {
  step_ = Step::kFailed;
  failure_ = {code, std::move(message)};
}

RobotTime RplidarSession::wake() const {
  switch (step_) {
    case Step::kClosed:
    case Step::kFailed: return kNever;
    case Step::kStopping:
    case Step::kBooting: return pause_until_;
    case Step::kScanning:
      return std::min(turning_ ? last_record_ + params_.scan_timeout : kNever,
                      last_revolution_ + params_.revolution_timeout);
    default: return enquiry_.deadline();
  }
}

void RplidarSession::close(RobotTime /*now*/) {
  if (step_ == Step::kClosed) {
    return;
  }
  send({Command::kStop, {}});
  if (found_.motor_by_pwm) {
    send(rplidar::set_motor_pwm(0));
  }
  if (params_.motor != RplidarMotor::kPwm) {
    act(SetDtr{true});
  }
  step_ = Step::kClosed;
  scan_.reset();
}

Status RplidarSession::state() const {
  const auto waiting = [](const char* what) {
    return fail(Errc::kNotReady, std::string("the RPLIDAR is being started: ") + what);
  };
  switch (step_) {
    case Step::kClosed: return fail(Errc::kNotReady, "the RPLIDAR's line is closed; activate the driver");
    case Step::kStopping:
    case Step::kInfo: return waiting("it is asked what it is");
    case Step::kHealth: return waiting("it is asked how it fares");
    case Step::kBooting: return waiting("it was in protection stop and boots again");
    case Step::kSampleRate:
    case Step::kAccBoard:
    case Step::kTypicalMode:
    case Step::kModeAnswer:
    case Step::kModePeriod: return waiting("it is asked how it measures");
    case Step::kStarting: return waiting("its scan was requested");
    case Step::kScanning: return turning_ ? Status{} : waiting("its rotor runs up");
    case Step::kFailed: return tl::unexpected<Error>(failure_);
  }
  return {};
}

LinkStatistics RplidarSession::statistics() const {
  LinkStatistics all = statistics_;
  all.packets_in = reader_.counts().whole;
  all.packets_bad = reader_.counts().damaged;
  all.bytes_skipped += reader_.counts().skipped;
  return all;
}

std::optional<LaserScan> RplidarSession::take_scan() { return std::exchange(scan_, std::nullopt); }

}  // namespace seeker::drivers
