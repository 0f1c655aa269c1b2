#include "common/wire/convert.hpp"
#include "common/wire/zstd.hpp"

namespace seeker::wire {
namespace {

RobotTime time_of(std::int64_t ns) { return RobotTime(Duration(ns)); }
std::int64_t ns_of(RobotTime time) { return time.time_since_epoch().count(); }

/// The rules of the sensor itself, as an error of this message.
template <class T>
void obey(const T& scan, Check& check) {
  if (const Status valid = validate(scan); check.ok() && !valid) {
    check.refuse("", valid.error().code, "is refused: " + valid.error().message);
  }
}

}  // namespace

void write(const LaserScan& from, pb::LaserScan* to) {
  to->set_stamp_ns(ns_of(from.stamp));
  to->set_angle_min_rad(from.angle_min_rad);
  to->set_angle_step_rad(from.angle_step_rad);
  to->set_range_min_m(from.range_min_m);
  to->set_range_max_m(from.range_max_m);
  write(from.base_T_laser, to->mutable_base_t_laser());
  to->mutable_ranges_m()->Add(from.ranges_m.begin(), from.ranges_m.end());
  to->set_quality(from.quality.data(), from.quality.size());
  to->set_sweep_ns(from.sweep.count());
}

void read(const pb::LaserScan& from, LaserScan& to, Check& check) {
  if (!check.count("ranges_m", static_cast<std::size_t>(from.ranges_m_size()), kMaxScanBeams) ||
      !check.count("quality", from.quality().size(), kMaxScanBeams)) {
    return;
  }
  to.stamp = time_of(from.stamp_ns());
  to.sweep = Duration(from.sweep_ns());
  to.angle_min_rad = check.finite("angle_min_rad", from.angle_min_rad());
  to.angle_step_rad = check.finite("angle_step_rad", from.angle_step_rad());
  to.range_min_m = check.finite("range_min_m", from.range_min_m());
  to.range_max_m = check.finite("range_max_m", from.range_max_m());
  read_required(from.has_base_t_laser(), from.base_t_laser(), to.base_T_laser, "base_t_laser", check);
  to.ranges_m.assign(from.ranges_m().begin(), from.ranges_m().end());
  to.quality.assign(from.quality().begin(), from.quality().end());
  obey(to, check);
}

void write(const SonarScan& from, pb::SonarScan* to) {
  to->set_stamp_ns(ns_of(from.stamp));
  to->set_range_max_m(from.range_max_m);
  to->set_cone_half_angle_rad(from.cone_half_angle_rad);
  for (const SonarReading& reading : from.readings) {
    pb::SonarReading* one = to->add_readings();
    write(reading.base_T_sonar, one->mutable_base_t_sonar());
    one->set_range_m(reading.range_m);
  }
}

void read(const pb::SonarScan& from, SonarScan& to, Check& check) {
  if (!check.count("readings", static_cast<std::size_t>(from.readings_size()), kMaxSonars)) {
    return;
  }
  to.stamp = time_of(from.stamp_ns());
  to.range_max_m = check.finite("range_max_m", from.range_max_m());
  to.cone_half_angle_rad = check.finite("cone_half_angle_rad", from.cone_half_angle_rad());
  for (int k = 0; k < from.readings_size(); ++k) {
    const auto scope = check.in("readings", static_cast<std::size_t>(k));
    const pb::SonarReading& one = from.readings(k);
    SonarReading reading;
    read_required(one.has_base_t_sonar(), one.base_t_sonar(), reading.base_T_sonar, "base_t_sonar", check);
    reading.range_m = one.range_m();
    to.readings.push_back(reading);
  }
  obey(to, check);
}

void write(const Image& from, pb::Image* to) {
  to->set_width_px(static_cast<std::uint32_t>(from.width_px()));
  to->set_height_px(static_cast<std::uint32_t>(from.height_px()));
  to->set_channels(static_cast<std::uint32_t>(from.channels()));
  std::string packed = compress(from.data());
  if (packed.size() < from.data().size()) {
    to->set_encoding(pb::Image::ENCODING_ZSTD);
    to->set_data(std::move(packed));
  } else {
    to->set_encoding(pb::Image::ENCODING_RAW);
    to->set_data(from.data().data(), from.data().size());
  }
}

void read(const pb::Image& from, Image& to, Check& check) {
  if (from.width_px() > static_cast<std::uint32_t>(kMaxImageSide_px) ||
      from.height_px() > static_cast<std::uint32_t>(kMaxImageSide_px)) {
    check.refuse("width_px", Errc::kTooLarge, "or height_px is above 8192");
    return;
  }
  if (from.channels() != 1 && from.channels() != 3) {
    check.refuse("channels", Errc::kInvalidArgument, "must be 1 or 3");
    return;
  }
  const std::size_t bytes = std::size_t{from.width_px()} * from.height_px() * from.channels();
  if (bytes > kMaxImageBytes) {
    check.refuse("data", Errc::kTooLarge, "unpacks to more than 64 MiB of pixels");
    return;
  }
  if (from.encoding() == pb::Image::ENCODING_RAW && from.data().size() != bytes) {
    check.refuse("data", Errc::kInvalidArgument, "does not have width * height * channels bytes");
    return;
  }
  if (from.encoding() != pb::Image::ENCODING_RAW && from.encoding() != pb::Image::ENCODING_ZSTD) {
    check.refuse("encoding", Errc::kInvalidArgument, "is not known here");
    return;
  }
  to = Image(static_cast<int>(from.width_px()), static_cast<int>(from.height_px()), static_cast<int>(from.channels()));
  if (from.encoding() == pb::Image::ENCODING_RAW) {
    to.data().assign(from.data().begin(), from.data().end());
  } else if (const Status unpacked = decompress(from.data(), to.data()); !unpacked) {
    check.refuse("data", unpacked.error().code, unpacked.error().message);
  }
}

void write(const api::ImageFrame& from, pb::ImageFrame* to) {
  to->set_camera(clean_text(from.camera, kMaxNameBytes));
  to->set_stamp_ns(ns_of(from.frame.stamp));
  write(from.frame.image, to->mutable_image());
  write(from.map_T_base, to->mutable_map_t_base());
}

void read(const pb::ImageFrame& from, api::ImageFrame& to, Check& check) {
  to.camera = check.text("camera", from.camera(), kMaxNameBytes);
  to.frame.stamp = time_of(from.stamp_ns());
  read_required(from.has_image(), from.image(), to.frame.image, "image", check);
  read_required(from.has_map_t_base(), from.map_t_base(), to.map_T_base, "map_t_base", check);
}

}  // namespace seeker::wire
