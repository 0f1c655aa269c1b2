#include "common/wire/convert.hpp"

namespace seeker::wire {
namespace {

constexpr unsigned char kContinuationMask = 0xC0;
constexpr unsigned char kContinuation = 0x80;

/// Bytes of the UTF-8 character that starts at `at`; 0 when none does.
std::size_t character_bytes(std::string_view text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t n = lead < 0x80 ? 1 : lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 0;
  if (n == 0 || at + n > text.size()) {
    return 0;
  }
  for (std::size_t k = 1; k < n; ++k) {
    if ((static_cast<unsigned char>(text[at + k]) & kContinuationMask) != kContinuation) {
      return 0;
    }
  }
  const auto second = n > 1 ? static_cast<unsigned char>(text[at + 1]) : 0;
  // Overlong forms, surrogates and values above the last code point.
  const bool bad = (lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
                   (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F);
  return bad ? 0 : n;
}

}  // namespace

std::string clean_text(std::string_view text, std::size_t limit) {
  std::string clean;
  clean.reserve(std::min(text.size(), limit));
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t n = character_bytes(text, at);
    const std::string_view piece = n == 0 ? std::string_view("?") : text.substr(at, n);
    if (clean.size() + piece.size() > limit) {
      break;
    }
    clean += piece;
    at += n == 0 ? 1 : n;
  }
  return clean;
}

std::string one_line(std::string_view text, std::size_t limit) {
  std::string line = clean_text(text, limit);
  constexpr char kDelete = 0x7f;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return (c >= 0 && c < ' ') || c == kDelete; }, ' ');
  return line;
}

void write(const Pose2& from, pb::Pose2* to) {
  to->set_x_m(from.x_m);
  to->set_y_m(from.y_m);
  to->set_theta_rad(from.theta_rad);
}

void read(const pb::Pose2& from, Pose2& to, Check& check) {
  to.x_m = check.finite("x_m", from.x_m());
  to.y_m = check.finite("y_m", from.y_m());
  to.theta_rad = check.finite("theta_rad", from.theta_rad());
}

void write(const Twist2& from, pb::Twist2* to) {
  to->set_v_m_s(from.v_m_s);
  to->set_omega_rad_s(from.omega_rad_s);
}

void read(const pb::Twist2& from, Twist2& to, Check& check) {
  to.v_m_s = check.finite("v_m_s", from.v_m_s());
  to.omega_rad_s = check.finite("omega_rad_s", from.omega_rad_s());
}

void write(const Point2& from, pb::Point2* to) {
  to->set_x_m(from.x());
  to->set_y_m(from.y());
}

void read(const pb::Point2& from, Point2& to, Check& check) {
  to = {check.finite("x_m", from.x_m()), check.finite("y_m", from.y_m())};
}

void write(const std::vector<Point2>& from, pb::PointList* to) {
  to->mutable_x_m()->Reserve(static_cast<int>(from.size()));
  to->mutable_y_m()->Reserve(static_cast<int>(from.size()));
  for (const Point2& p : from) {
    to->add_x_m(p.x());
    to->add_y_m(p.y());
  }
}

void read(const pb::PointList& from, std::vector<Point2>& to, Check& check, std::size_t limit) {
  const auto n = static_cast<std::size_t>(from.x_m_size());
  if (from.x_m_size() != from.y_m_size()) {
    check.refuse("y_m", Errc::kInvalidArgument, "has not as many entries as x_m");
    return;
  }
  if (!check.count("x_m", n, limit)) {
    return;
  }
  to.reserve(n);
  for (int k = 0; k < from.x_m_size(); ++k) {
    to.emplace_back(check.finite("x_m", from.x_m(k)), check.finite("y_m", from.y_m(k)));
  }
}

void write(const std::vector<api::StampedPose>& from, pb::PoseList* to) {
  for (const api::StampedPose& pose : from) {
    to->add_x_m(pose.map_T_base.x_m);
    to->add_y_m(pose.map_T_base.y_m);
    to->add_theta_rad(pose.map_T_base.theta_rad);
    to->add_stamp_ns(pose.stamp.time_since_epoch().count());
  }
}

void read(const pb::PoseList& from, std::vector<api::StampedPose>& to, Check& check) {
  const bool stamps = from.stamp_ns_size() == 0 || from.stamp_ns_size() == from.x_m_size();
  if (from.x_m_size() != from.y_m_size() || from.x_m_size() != from.theta_rad_size() || !stamps) {
    check.refuse("", Errc::kInvalidArgument, "has lists of different length");
    return;
  }
  if (!check.count("x_m", static_cast<std::size_t>(from.x_m_size()), kMaxTrajectoryPoses)) {
    return;
  }
  to.reserve(static_cast<std::size_t>(from.x_m_size()));
  for (int k = 0; k < from.x_m_size(); ++k) {
    const RobotTime stamp(Duration(from.stamp_ns_size() == 0 ? 0 : from.stamp_ns(k)));
    to.push_back({stamp,
                  {check.finite("x_m", from.x_m(k)), check.finite("y_m", from.y_m(k)),
                   check.finite("theta_rad", from.theta_rad(k))}});
  }
}

}  // namespace seeker::wire
