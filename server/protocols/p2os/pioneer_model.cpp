#include "server/protocols/p2os/pioneer_model.hpp"

#include <algorithm>
#include <array>

namespace seeker::p2os {
namespace {

struct SonarPlace {
  double x_mm;
  double y_mm;
  double theta_deg;
};

/// params/p3dx.p and p3dx-sh.p.
constexpr std::array<SonarPlace, 2 * kArraySonars> kP3dxSonars{{{69, 136, 90},
                                                                {114, 119, 50},
                                                                {148, 78, 30},
                                                                {166, 27, 10},
                                                                {166, -27, -10},
                                                                {148, -78, -30},
                                                                {114, -119, -50},
                                                                {69, -136, -90},
                                                                {-157, -136, -90},
                                                                {-203, -119, -130},
                                                                {-237, -78, -150},
                                                                {-255, -27, -170},
                                                                {-255, 27, 170},
                                                                {-237, 78, 150},
                                                                {-203, 119, 130},
                                                                {-157, 136, 90}}};
/// params/p3at.p and p3at-sh.p.
constexpr std::array<SonarPlace, 2 * kArraySonars> kP3atSonars{{{147, 136, 90},
                                                                {193, 119, 50},
                                                                {227, 79, 30},
                                                                {245, 27, 10},
                                                                {245, -27, -10},
                                                                {227, -79, -30},
                                                                {193, -119, -50},
                                                                {147, -136, -90},
                                                                {-144, -136, -90},
                                                                {-189, -119, -130},
                                                                {-223, -79, -150},
                                                                {-241, -27, -170},
                                                                {-241, 27, 170},
                                                                {-223, 79, 150},
                                                                {-189, 119, 130},
                                                                {-144, 136, 90}}};

std::vector<Pose2> poses(const std::array<SonarPlace, 2 * kArraySonars>& places) {
  std::vector<Pose2> base_T_sonar;
  base_T_sonar.reserve(places.size());
  for (const SonarPlace& place : places) {
    base_T_sonar.push_back({place.x_mm * kMetre, place.y_mm * kMetre, deg_to_rad(place.theta_deg)});
  }
  return base_T_sonar;
}

PioneerModel p3dx(std::string_view subclass, double distance_unit_m) {
  PioneerModel model;
  model.subclass = subclass;
  model.distance_unit_m = distance_unit_m;
  model.rotation_rad_per_m = 5.6;
  model.v_max_m_s = 2.2;
  model.omega_max_rad_s = deg_to_rad(500.0);
  model.radius_m = 0.25;
  model.base_T_sonar = poses(kP3dxSonars);
  return model;
}

PioneerModel p3at(std::string_view subclass, double distance_unit_m) {
  PioneerModel model;
  model.subclass = subclass;
  model.distance_unit_m = distance_unit_m;
  model.rotation_rad_per_m = 3.4;
  model.v_max_m_s = 1.2;
  model.omega_max_rad_s = deg_to_rad(300.0);
  model.radius_m = 0.5;
  model.base_T_sonar = poses(kP3atSonars);
  return model;
}

/// The newer boards (-sh) count millimetres.
const std::array<PioneerModel, 4>& models() {
  static const std::array<PioneerModel, 4> table{p3dx("p3dx", 0.485 * kMetre), p3dx("p3dx-sh", kMetre),
                                                 p3at("p3at", 0.465 * kMetre), p3at("p3at-sh", kMetre)};
  return table;
}

bool is_equipped(std::string_view subclass, const PioneerModel& model) {
  constexpr std::string_view kNewBoard = "-sh";
  return model.subclass.ends_with(kNewBoard) && subclass.starts_with(model.subclass) &&
         subclass.substr(model.subclass.size()).starts_with('-');
}

}  // namespace

const PioneerModel* find_pioneer_model(std::string_view subclass) {
  const auto found = std::find_if(models().begin(), models().end(), [&](const PioneerModel& model) {
    return model.subclass == subclass || is_equipped(subclass, model);
  });
  return found == models().end() ? nullptr : &*found;
}

std::string known_subclasses() {
  std::string text;
  for (const PioneerModel& model : models()) {
    text += (text.empty() ? "" : ", ") + std::string(model.subclass);
  }
  return text;
}

}  // namespace seeker::p2os
