#include "common/wire/convert.hpp"

namespace seeker::wire {

void write(const api::LandmarkSummary& from, pb::LandmarkSummary* to) {
  to->set_name(clean_text(from.name, kMaxMapNameBytes));
  to->set_robot_id(clean_text(from.robot_id, kMaxMapNameBytes));
  to->set_software_version(clean_text(from.software_version, kMaxMapNameBytes));
  to->set_map_name(clean_text(from.map_name, kMaxMapNameBytes));
  to->set_calibration(from.calibration);
  to->set_created_unix_s(from.created_unix_s);
  to->set_saved_unix_s(from.saved_unix_s);
  to->set_file_bytes(from.file_bytes);
  to->set_revision(from.revision);
  to->set_landmarks(from.landmarks);
  to->set_problem(clean_text(from.problem));
}

void read(const pb::LandmarkSummary& from, api::LandmarkSummary& to, Check& check) {
  to.name = check.text("name", from.name(), kMaxMapNameBytes);
  to.robot_id = check.text("robot_id", from.robot_id(), kMaxMapNameBytes);
  to.software_version = check.text("software_version", from.software_version(), kMaxMapNameBytes);
  to.map_name = check.text("map_name", from.map_name(), kMaxMapNameBytes);
  to.calibration = from.calibration();
  to.created_unix_s = from.created_unix_s();
  to.saved_unix_s = from.saved_unix_s();
  to.file_bytes = from.file_bytes();
  to.revision = from.revision();
  to.landmarks = from.landmarks();
  to.problem = check.text("problem", from.problem());
}

void write(const api::LandmarkPoint& from, pb::Landmark* to) {
  to->set_id(from.id);
  to->set_x_m(from.p.x());
  to->set_y_m(from.p.y());
  to->set_z_m(from.z_m);
  to->set_sigma_m(from.sigma_m);
  to->set_views(from.views);
}

void read(const pb::Landmark& from, api::LandmarkPoint& to, Check& check) {
  to.id = from.id();
  if (to.id == 0) {
    check.refuse("id", Errc::kInvalidArgument, "must not be 0");
  }
  to.p = {check.finite("x_m", from.x_m()), check.finite("y_m", from.y_m())};
  to.z_m = check.finite("z_m", from.z_m());
  to.sigma_m = check.finite("sigma_m", from.sigma_m());
  to.views = from.views();
}

}  // namespace seeker::wire
