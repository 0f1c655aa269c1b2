#include "tests/support/fake_answers.hpp"

#include <algorithm>

#include "common/digest/sha256.hpp"

namespace seeker::testing {
namespace {

api::LandmarkSummary summary_of(const std::string& name, const std::vector<api::LandmarkPoint>& landmarks) {
  api::LandmarkSummary summary;
  summary.name = name;
  summary.landmarks = static_cast<std::uint32_t>(landmarks.size());
  return summary;
}

}  // namespace

Result<api::LeaseState> fake_lease(api::LeaseState& state, api::LeaseAction action, const std::string& me) {
  const auto hand_to = [&](const std::string& owner) {
    state = {.owner = owner, .epoch = state.epoch + 1, .requested_by = ""};
    return state;
  };
  switch (action) {
    case api::LeaseAction::kAcquire:
      if (state.owner == me) {
        state.stale = false;
        return state;
      }
      if (!state.owner.empty() && !state.stale) {
        return fail(Errc::kBusy, "'" + state.owner + "' holds the lease; request it or take it over");
      }
      return hand_to(me);
    case api::LeaseAction::kTakeOver: return hand_to(me);
    case api::LeaseAction::kRequest:
      if (state.owner.empty()) {
        return hand_to(me);
      }
      state.requested_by = me;
      return state;
    default: break;
  }
  if (state.owner != me) {
    return fail(Errc::kRefused, "only the owner of the lease may do this");
  }
  if (action == api::LeaseAction::kRelease) {
    return hand_to("");
  }
  if (action == api::LeaseAction::kGrant) {
    return hand_to(state.requested_by);
  }
  state.requested_by.clear();
  return state;
}

void fake_end_mission(FakeRobotValues& values) {
  values.mission->state = api::MissionState::kEnded;
  values.mission->end = api::MissionEnd{api::Outcome::kOperator, "stopped by an operator", "", {}};
}

tl::unexpected<Error> fake_no_such_map(const std::string& name) {
  return fail(Errc::kNotFound, "there is no map '" + name + "'; none has been saved yet");
}

Result<api::MapSummary> fake_find_map(const FakeRobotValues& values, const std::string& name) {
  for (const api::MapSummary& map : values.maps) {
    if (map.name == name) {
      return map;
    }
  }
  return fake_no_such_map(name);
}

std::vector<api::LandmarkSummary> fake_list_landmarks(const FakeRobotValues& values) {
  std::vector<api::LandmarkSummary> databases;
  for (const auto& [name, landmarks] : values.landmarks) {
    databases.push_back(summary_of(name, landmarks));
  }
  return databases;
}

Result<std::vector<api::LandmarkPoint>> fake_landmarks(const FakeRobotValues& values, const std::string& name) {
  const auto found = values.landmarks.find(name);
  if (found == values.landmarks.end()) {
    return fail(Errc::kNotFound, "there is no database of landmarks '" + name + "'; 'seeker survey' makes one");
  }
  return found->second;
}

Result<api::LandmarkSummary> fake_inspect_landmarks(const FakeRobotValues& values, const std::string& name) {
  const auto landmarks = fake_landmarks(values, name);
  return landmarks ? summary_of(name, *landmarks)
                   : Result<api::LandmarkSummary>(tl::unexpected<Error>(landmarks.error()));
}

Result<api::LandmarkSummary> fake_prune_landmarks(FakeRobotValues& values, const std::string& name, int min_views) {
  if (const auto known = fake_landmarks(values, name); !known) {
    return tl::unexpected<Error>(known.error());
  }
  values.landmarks_before[name] = values.landmarks[name];
  std::erase_if(values.landmarks[name], [&](const api::LandmarkPoint& landmark) {
    return landmark.views < static_cast<std::uint32_t>(min_views);
  });
  return fake_inspect_landmarks(values, name);
}

Result<api::LandmarkSummary> fake_revert_landmarks(FakeRobotValues& values, const std::string& name) {
  if (const auto known = fake_landmarks(values, name); !known) {
    return tl::unexpected<Error>(known.error());
  }
  const auto before = values.landmarks_before.extract(name);
  if (before.empty()) {
    return fail(Errc::kNotReady, "database '" + name + "' has no version before the present one");
  }
  values.landmarks[name] = before.mapped();
  return fake_inspect_landmarks(values, name);
}

Result<api::MissionAccepted> fake_start_mission(FakeRobotValues& v, const api::MissionRequest& request) {
  if (const Status valid = api::validate(request); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  if (v.mission && !v.mission->end && v.mission->id != request.id) {
    return fail(Errc::kBusy, "mission '" + v.mission->id + "' runs; stop it first");
  }
  if (!v.mission || v.mission->id != request.id) {
    v.missions.push_back(request);
    v.mission = api::MissionStatus{};
    v.mission->id = request.id;
    v.mission->kind = std::string(api::task_name(request.task));
    v.mission->phase = "cover";
    v.mission->link_policy = request.link_policy;
    v.mission->link_steps = request.link_steps.empty()
                                ? api::link_steps_of(request.link_policy, std::chrono::seconds(5))
                                : request.link_steps;
  }
  return api::MissionAccepted{request.id, v.mission->link_steps};
}

Result<std::uint64_t> fake_begin_upload(FakeRobotValues& values, const api::FileOffer& offer) {
  if (values.too_old_for_pieces) {
    return fail(Errc::kUnsupportedVersion, "this robot does not know the call; it speaks protocol 1.5");
  }
  FakeRobotValues::Incoming& incoming = values.incoming[offer.hash];
  incoming.size_bytes = offer.size_bytes;
  return incoming.bytes.size();
}

Result<std::uint64_t> fake_upload_piece(FakeRobotValues& values, const api::UploadPiece& piece) {
  const auto found = values.incoming.find(piece.hash);
  if (found == values.incoming.end()) {
    return fail(Errc::kNotFound, "the file was not begun");
  }
  std::vector<std::uint8_t>& bytes = found->second.bytes;
  if (piece.offset > bytes.size()) {
    return fail(Errc::kRefused, "bytes before the piece are missing");
  }
  values.piece_bytes += piece.bytes.size();
  const auto known = std::min(bytes.size() - static_cast<std::size_t>(piece.offset), piece.bytes.size());
  bytes.insert(bytes.end(), piece.bytes.begin() + static_cast<std::ptrdiff_t>(known), piece.bytes.end());
  return bytes.size();
}

Result<api::UploadedFile> fake_finish_upload(FakeRobotValues& values, const api::UploadEnd& end) {
  const auto found = values.incoming.find(end.hash);
  if (found == values.incoming.end() || found->second.bytes.size() != found->second.size_bytes) {
    return fail(Errc::kNotFound, "the file is not here as a whole");
  }
  api::UploadedFile file;
  const std::vector<std::uint8_t>& bytes = found->second.bytes;
  if (end.kind == api::FileKind::kMap) {
    values.uploads.push_back({end.name, bytes, end.replace, end.check_only});
    file.map.emplace();
    file.map->name = end.name;
    file.map->file_bytes = bytes.size();
  } else if (end.kind == api::FileKind::kLandmarks) {
    values.landmark_files[end.name] = bytes;
    file.landmarks.emplace();
    file.landmarks->name = end.name;
    file.landmarks->file_bytes = bytes.size();
  }
  return file;
}

Result<api::FilePiece> fake_read_file(const FakeRobotValues& values, const api::FileRead& wish) {
  if (values.too_old_for_pieces) {
    return fail(Errc::kUnsupportedVersion, "this robot does not know the call; it speaks protocol 1.5");
  }
  const auto& files = wish.kind == api::FileKind::kMap ? values.map_files : values.landmark_files;
  const auto found = files.find(wish.name);
  if (found == files.end()) {
    return fail(Errc::kNotFound, "there is no file '" + wish.name + "'");
  }
  const std::vector<std::uint8_t>& bytes = found->second;
  api::FilePiece piece{digest::sha256_of(bytes), bytes.size(), {}};
  if (wish.hash && *wish.hash != piece.hash) {
    return fail(Errc::kRefused, "'" + wish.name + "' has changed since the download began; begin again");
  }
  const std::size_t from = std::min(static_cast<std::size_t>(wish.offset), bytes.size());
  const std::size_t to = std::min(from + wish.max_bytes, bytes.size());
  piece.bytes.assign(bytes.begin() + static_cast<std::ptrdiff_t>(from),
                     bytes.begin() + static_cast<std::ptrdiff_t>(to));
  return piece;
}

Status fake_component(FakeRobotValues& values, const std::string& name,
                      const std::function<void(api::ComponentInfo&)>& change) {
  for (api::ComponentInfo& component : values.components) {
    if (component.name == name) {
      change(component);
      return {};
    }
  }
  return fail(Errc::kNotFound, "no component '" + name + "'; seeker components lists them");
}

Result<std::vector<api::ComponentSetting>> fake_settings(const FakeRobotValues& values, const std::string& component) {
  const auto found = values.settings.find(component);
  if (found == values.settings.end()) {
    return fail(Errc::kNotFound, "no component '" + component + "'; seeker components lists them");
  }
  return found->second;
}

Result<std::vector<api::ComponentSetting>> fake_set_settings(FakeRobotValues& values, const std::string& component,
                                                             const std::vector<std::string>& assignments) {
  std::vector<api::ComponentSetting> changed;
  for (const std::string& assignment : assignments) {
    const std::size_t equals = assignment.find('=');
    const std::string value = equals == std::string::npos ? "bad" : assignment.substr(equals + 1);
    for (api::ComponentSetting& setting : values.settings[component]) {
      if (setting.key != assignment.substr(0, equals)) {
        continue;
      }
      if (value == "bad") {
        return fail(Errc::kInvalidArgument, setting.path + ": expected a number, got 'bad'");
      }
      setting.value = value;
      changed.push_back(setting);
    }
  }
  return changed;
}

}  // namespace seeker::testing
