#include "server/vision/solids/target_recogniser.hpp"

#include <algorithm>
#include <utility>

namespace seeker::vision {
namespace {

Result<std::unique_ptr<Recogniser>> make_solids(const std::vector<TargetModel>& targets, const RecogniserParams& params,
                                                const SolidModel* solids) {
  if (solids == nullptr) {
    return fail(Errc::kRefused,
                "this robot has no model to recognise solids with; train one with 'seeker-lab train-solids' and name "
                "it in the robot file: search.solids.model");
  }
  if (params.view.omni) {
    return fail(Errc::kRefused,
                "solids cannot be recognised by an omnidirectional camera, only by one that looks down "
                "at them; use another robot, or look for the target by a picture of it");
  }
  WantedSolids wanted(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (targets[i].kind == TargetKind::kSolid) {
      wanted[i] = targets[i].solid;
    }
  }
  Result<std::unique_ptr<SolidRecogniser>> made = SolidRecogniser::make(wanted, *solids, params.view);
  if (!made) {
    return tl::unexpected<Error>(made.error());
  }
  return std::unique_ptr<Recogniser>(std::move(*made));
}

}  // namespace

Result<std::unique_ptr<Recogniser>> make_target_recogniser(const std::vector<TargetModel>& targets,
                                                           const RecogniserParams& params, const SolidModel* solids) {
  const auto is_solid = [](const TargetModel& target) { return target.kind == TargetKind::kSolid; };
  std::vector<std::unique_ptr<Recogniser>> parts;
  if (!std::all_of(targets.begin(), targets.end(), is_solid) || targets.empty()) {
    Result<std::unique_ptr<Recogniser>> pictures = make_recogniser(targets, params);
    if (!pictures) {
      return pictures;
    }
    parts.push_back(std::move(*pictures));
  }
  if (std::any_of(targets.begin(), targets.end(), is_solid)) {
    Result<std::unique_ptr<Recogniser>> solids_part = make_solids(targets, params, solids);
    if (!solids_part) {
      return solids_part;
    }
    parts.push_back(std::move(*solids_part));
  }
  return combine(std::move(parts));
}

}  // namespace seeker::vision
