#include "server/emulator/truth_log.hpp"

#include <limits>

namespace seeker::emulator {

Status TruthLog::open(const std::filesystem::path& file) {
  out_.open(file, std::ios::trunc);
  out_.precision(std::numeric_limits<double>::max_digits10);
  out_ << "time_s,robot,x_m,y_m,theta_rad,contacts\n";
  if (!out_) {
    return fail(Errc::kIo, "cannot write " + file.string() + "; check the folder and its space");
  }
  return {};
}

void TruthLog::add(const sim::SharedWorld& world) {
  for (std::size_t i = 0; i < world.size(); ++i) {
    const sim::GroundTruth truth = world.robot(i).truth();
    const Pose2& pose = truth.world_T_base;
    out_ << to_seconds(world.now()) << ',' << i << ',' << pose.x_m << ',' << pose.y_m << ',' << pose.theta_rad << ','
         << truth.contacts << '\n';
  }
  out_.flush();
}

}  // namespace seeker::emulator
