#include "server/search/fuzzy_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>

#include <fl/Headers.h>

#include "common/core/angle.hpp"

namespace seeker::search {
namespace {

constexpr std::array<const char*, kSectors + 1> kInputNames{"L", "LF", "F", "RF", "R", "TARGET"};
constexpr const char* kOutputName = "TURN";
constexpr std::size_t kMaxFllBytes = 1U << 20;

}  // namespace

struct FuzzyPlanner::Impl {
  std::unique_ptr<fl::Engine> engine;
  std::array<fl::InputVariable*, kSectors + 1> inputs{};
  fl::OutputVariable* output = nullptr;
};

std::string_view to_string(PlannerStop stop) {
  switch (stop) {
    case PlannerStop::kInvalidInput: return "a sonar or the target's bearing is not a number";
    case PlannerStop::kNoRule: return "no rule of the local planner fits";
  }
  return "unknown";
}

FuzzyPlanner::FuzzyPlanner(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
FuzzyPlanner::FuzzyPlanner(FuzzyPlanner&&) noexcept = default;
FuzzyPlanner& FuzzyPlanner::operator=(FuzzyPlanner&&) noexcept = default;
FuzzyPlanner::~FuzzyPlanner() = default;

Result<FuzzyPlanner> FuzzyPlanner::create(const std::string& fll_text) {
  if (fll_text.size() > kMaxFllBytes) {
    return fail(Errc::kTooLarge, "the rule file is larger than 1 MiB; give the local planner's FLL file");
  }
  auto impl = std::make_unique<Impl>();
  try {
    fl::FllImporter importer;
    impl->engine.reset(importer.fromString(fll_text));
    for (std::size_t k = 0; k < kInputNames.size(); ++k) {
      impl->inputs.at(k) = impl->engine->getInputVariable(kInputNames.at(k));
    }
    impl->output = impl->engine->getOutputVariable(kOutputName);
    std::string reason;
    if (!impl->engine->isReady(&reason)) {
      return fail(Errc::kParse, "the rule file is incomplete (" + reason + "); restore config/fuzzy/planner.fll");
    }
  } catch (const std::exception& error) {
    return fail(Errc::kParse, std::string("the rule file does not describe the local planner (") + error.what() +
                                  "); restore config/fuzzy/planner.fll");
  }
  // isReady() passes an engine that can do nothing.
  if (impl->engine->numberOfRuleBlocks() == 0 || impl->engine->getRuleBlock(0)->numberOfRules() == 0) {
    return fail(Errc::kParse, "the rule file has no rules; restore config/fuzzy/planner.fll");
  }
  // An undefined output is NaN, in spite of the file: it becomes a stop below.
  impl->output->setDefaultValue(fl::nan);
  impl->output->setLockPreviousValue(false);
  return FuzzyPlanner(std::move(impl));
}

HeadingResult FuzzyPlanner::infer(const Sectors& sectors, double target_rad) {
  if (!std::isfinite(target_rad)) {
    return tl::unexpected(PlannerStop::kInvalidInput);
  }
  for (std::size_t k = 0; k < kSectors; ++k) {
    if (!std::isfinite(sectors.distance_m[k])) {
      return tl::unexpected(PlannerStop::kInvalidInput);
    }
    impl_->inputs[k]->setValue(std::clamp(sectors.distance_m[k], 0.0, kMaxDistance_m));
  }
  impl_->inputs[kSectors]->setValue(wrap_angle(target_rad));
  try {
    impl_->engine->process();
  } catch (const std::exception&) {
    return tl::unexpected(PlannerStop::kNoRule);
  }
  const double heading = impl_->output->getValue();
  if (!std::isfinite(heading)) {
    return tl::unexpected(PlannerStop::kNoRule);
  }
  return std::clamp(heading, -kPi, kPi);
}

std::size_t FuzzyPlanner::rule_count() const { return impl_->engine->getRuleBlock(0)->numberOfRules(); }

}  // namespace seeker::search
