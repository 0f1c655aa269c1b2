#include "common/config/yaml_guard.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <sstream>

namespace seeker::config {
namespace {

/// Counts nodes and refuses aliases before the document is built.
class Guard final : public YAML::EventHandler {
 public:
  [[nodiscard]] const std::string& problem() const { return problem_; }
  [[nodiscard]] int line() const { return line_; }

  void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { node(mark, anchor); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    note(mark, "aliases (*name) are not allowed; write the value again");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                const std::string& /*value*/) override {
    node(mark, anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    node(mark, anchor);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    node(mark, anchor);
  }
  void OnMapEnd() override {}

 private:
  void node(const YAML::Mark& mark, YAML::anchor_t anchor) {
    constexpr std::size_t kMaxNodes = 1'000'000;
    if (anchor != 0) {
      note(mark, "anchors (&name) are not allowed");
    }
    if (++nodes_ > kMaxNodes) {
      note(mark, "more than a million values");
    }
  }
  void note(const YAML::Mark& mark, const char* problem) {
    if (problem_.empty()) {
      problem_ = problem;
      line_ = mark.line + 1;
    }
  }

  std::size_t nodes_ = 0;
  std::string problem_;
  int line_ = 0;
};

}  // namespace

Status guard_yaml(std::string_view text, const std::string& name) {
  try {
    std::istringstream input{std::string(text)};
    YAML::Parser parser(input);
    Guard guard;
    parser.HandleNextDocument(guard);
    if (!guard.problem().empty()) {
      return fail(Errc::kParse, name + ":" + std::to_string(guard.line()) + ": " + guard.problem());
    }
  } catch (const YAML::Exception& error) {
    return fail(Errc::kParse, name + ":" + std::to_string(error.mark.line + 1) + ": " + error.msg);
  }
  return {};
}

}  // namespace seeker::config
