#include <iomanip>

#include <nlohmann/json.hpp>

#include "client/cli/export_check.hpp"
#include "client/cli/export_files.hpp"
#include "client/cli/scene.hpp"
#include "client/cli/show_done.hpp"
#include "client/cli/verbs.hpp"
#include "client/values/values.hpp"
#include "client/values/values_json.hpp"
#include "common/image/export_mark.hpp"
#include "common/image/png.hpp"

namespace seeker::cli {
namespace {

/// "name       value" on a line of its own.
void row(const Context& context, const std::string& name, const std::string& value) {
  constexpr int kColumn = 12;
  *context.out << std::left << std::setw(kColumn) << name << value << '\n';
}

/// Red where something is wrong, when the terminal shows colours.
std::string alarm(const Context& context, const std::string& text) {
  return context.colour ? "\x1b[31m" + text + "\x1b[0m" : text;
}

/// "21227 ticks, 3 late by more than 20 ms, worst 0.031 s"
std::string lateness(const TickTiming& timing) {
  return count_of(timing.ticks, "tick") + ", " + std::to_string(timing.late) +
         fixed(" late by more than %.0f ms, ", 1e3 * to_seconds(TickTiming::kLate)) +
         fixed("worst %.3f s", to_seconds(timing.worst));
}

void print_status(const Context& context, const api::RobotInfo& info, const api::RobotStatus& s) {
  row(context, "robot", info.robot_id + " (version " + info.software_version + ")");
  row(context, "time", fixed("%.1f s", to_seconds(s.stamp)));
  row(context, "pose",
      place_text(s.pose) +
          (is_placed(s.pose.quality) ? fixed(" \xC2\xB1 %.2f m", sigma_m(s.pose.covariance.topLeftCorner<2, 2>()))
                                     : "") +
          ", " + std::string(to_string(s.pose.quality)) + (s.pose.cause.empty() ? "" : ": " + s.pose.cause));
  if (s.line_map) {
    const api::LineMapStatus& map = *s.line_map;
    row(context, "map",
        count_of(map.segments, "segment") + ", " +
            (map.name.empty() ? std::string("not saved yet") : "'" + map.name + "'") +
            (map.use == api::MapUse::kLocalise ? ", only localised in" : "") +
            (map.relocalising ? ", the robot looks for its place in it" : ""));
  }
  if (s.timing) {
    row(context, "loop", lateness(*s.timing));
  }
  row(context, "velocity", fixed("%.2f m/s, ", s.velocity.v_m_s) + fixed("%.2f rad/s", s.velocity.omega_rad_s));
  if (s.battery_v) {
    row(context, "battery", fixed("%.1f V", *s.battery_v));
  }
  row(context, "motors",
      s.estop ? alarm(context, "EMERGENCY STOP latched; seeker estop --release")
              : (s.motors_armed ? "armed" : "not armed"));
  row(context, "lease", text_of(s.lease));
  if (!s.safety.empty()) {
    row(context, "safety", s.safety);
  }
  if (s.mission) {
    const api::MissionStatus& m = *s.mission;
    row(context, "mission", m.kind + " " + m.id + " " + std::string(to_string(m.state)));
    row(context, "",
        m.end ? std::string(to_string(m.end->outcome)) + ": " + m.end->cause
              : fixed("%.0f %% ", 100.0 * m.progress) + m.phase + ": " + m.activity);
    row(context, "if alone", text_of(m.link_steps, m.link_policy));
    if (s.link_countdown) {
      row(context, "alone", alarm(context, "the client of the mission is " + text_of(*s.link_countdown)));
    }
  } else {
    row(context, "mission", "none");
  }
  if (s.cut_off) {
    row(context, "cut off", s.cut_off->id + "; 'seeker resume' goes on with it");
  }
  for (const api::Fault& fault : s.faults) {
    row(context, "fault", alarm(context, fault.component + ": " + fault.message) + "; " + fault.remedy);
  }
}

}  // namespace

VerbResult show_status(const Context& context) {
  const Result<api::RobotInfo> info = ask<api::RobotInfo>(context, &api::RobotApi::get_info);
  if (!info) {
    return tl::unexpected<Error>(info.error());
  }
  const Result<api::RobotStatus> status = ask<api::RobotStatus>(context, &api::RobotApi::get_status);
  if (!status) {
    return tl::unexpected<Error>(status.error());
  }
  if (context.json) {
    const Json json = {{"robot_id", info->robot_id},         {"software_version", info->software_version},
                       {"capabilities", info->capabilities}, {"robot_radius_m", info->robot_radius_m},
                       {"realtime", info->realtime},         {"status", *status}};
    *context.out << json_line(json) << '\n';
  } else {
    print_status(context, *info, *status);
  }
  return ExitCode::kOk;
}

VerbResult show_detections(const Context& context) {
  const auto detections = ask<std::vector<api::Detection>>(context, &api::RobotApi::get_detections);
  if (!detections) {
    return tl::unexpected<Error>(detections.error());
  }
  if (context.json) {
    *context.out << json_line(Json{{"detections", *detections}}) << '\n';
    return ExitCode::kOk;
  }
  for (const api::Detection& detection : *detections) {
    *context.out << text_of(detection) << '\n';
  }
  if (detections->empty()) {
    say(context, "nothing was found yet");
  }
  return ExitCode::kOk;
}

VerbResult show_grid(const Context& context, const GridVerb& verb) {
  const Result<api::GridReport> grid = ask<api::GridReport>(context, &api::RobotApi::get_grid);
  if (!grid) {
    return tl::unexpected<Error>(grid.error());
  }
  if (!verb.evidence.empty()) {
    const Result<image::MapScene> scene = fetch_scene(context, SceneOf::kEvidence);
    if (!scene) {
      return tl::unexpected<Error>(scene.error());
    }
    if (const Status ok = save_scene(verb.evidence, *scene); !ok) {
      return tl::unexpected<Error>(ok.error());
    }
    say(context, "wrote " + verb.evidence);
  }
  if (context.json) {
    *context.out << json_line(Json(*grid)) << '\n';
    return ExitCode::kOk;
  }
  const api::GridLists& lists = grid->lists;
  row(context, "cells",
      std::to_string(lists.searched.size()) + " searched, " + std::to_string(lists.unsearched.size()) + " to search, " +
          std::to_string(lists.unreachable.size()) + " unreachable" + fixed(", side %.2f m", lists.cell_size_m));
  row(context, "covered", text_of(grid->evidence.summary));
  const std::vector<std::string> gaps = lines_of(grid->evidence.gaps);
  row(context, "gaps", std::to_string(gaps.size()));
  for (const std::string& gap : gaps) {
    row(context, "", gap);
  }
  for (const Point2& cell : lists.unreachable) {
    row(context, "unreachable", text_of(cell));
  }
  return ExitCode::kOk;
}

VerbResult grab_image(const Context& context, const CameraGrabVerb& verb) {
  const Result<api::ImageFrame> frame = ask<api::ImageFrame>(
      context, [&](api::Reply<api::ImageFrame> reply) { context.robot->grab_image(verb.camera, std::move(reply)); });
  if (!frame) {
    return tl::unexpected<Error>(frame.error());
  }
  const std::string file = verb.out.empty() ? frame->camera + ".png" : verb.out;
  const Image& picture = frame->frame.image;
  // A name that the user gave is theirs to overwrite.
  Status ok = verb.out.empty() ? check_replaceable({file}, image::kCameraPicture) : Status();
  ok = ok ? save_picture(file, picture, image::kCameraPicture) : ok;
  if (!ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (context.json) {
    const Json json = {{"file", file},
                       {"camera", frame->camera},
                       {"stamp_s", to_seconds(frame->frame.stamp)},
                       {"width_px", picture.width_px()},
                       {"height_px", picture.height_px()}};
    *context.out << json_line(json) << '\n';
  } else {
    *context.out << file << '\n';
  }
  return ExitCode::kOk;
}

VerbResult export_map(const Context& context, const MapExportVerb& verb) {
  return show_files(context, export_map_files(context, verb.name, verb.formats));
}

}  // namespace seeker::cli
