#include "server/lines/make_extractor.hpp"

#include <utility>

namespace seeker::lines {
namespace {

/// An extractor without state behind the interface.
template <class Stateless>
class StatelessExtractor final : public Extractor {
 public:
  explicit StatelessExtractor(Stateless extractor) : extractor_(std::move(extractor)) {}
  void extract(const LaserScan& scan, ScanLines& found) override { found = extractor_.extract(scan); }

 private:
  Stateless extractor_;
};

template <class Stateless>
std::unique_ptr<Extractor> behind_interface(Stateless extractor) {
  return std::make_unique<StatelessExtractor<Stateless>>(std::move(extractor));
}

}  // namespace

std::string_view to_string(ExtractorKind kind) {
  switch (kind) {
    case ExtractorKind::kFast: return "fast";
    case ExtractorKind::kFiveModes: return "five_modes";
    case ExtractorKind::kRegression: return "regression";
    case ExtractorKind::kSplitAndMerge: return "split_and_merge";
    case ExtractorKind::kIepf: return "iepf";
  }
  return "unknown";
}

std::unique_ptr<Extractor> make_extractor(const ExtractorParams& params) {
  switch (params.kind) {
    case ExtractorKind::kFast: break;
    case ExtractorKind::kFiveModes: return behind_interface(PaperExtractor(params.five_modes));
    case ExtractorKind::kRegression: return behind_interface(RegressionExtractor(params.regression));
    case ExtractorKind::kSplitAndMerge: return behind_interface(SplitAndMerge(params.split));
    case ExtractorKind::kIepf: return behind_interface(Iepf(params.split));
  }
  return std::make_unique<FastExtractor>(params.fast);
}

}  // namespace seeker::lines
