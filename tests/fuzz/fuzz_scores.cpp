/// \file
/// Any text through the line parsers of trajectories and relations, and what they accept on to a score.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/core/assert.hpp"
#include "server/lab/scoring/score_reference.hpp"
#include "server/lab/scoring/score_relations.hpp"

// NOLINTNEXTLINE: the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  seeker::lab::Trajectory trajectory;
  std::vector<seeker::lab::Relation> relations;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    const auto pose = seeker::lab::parse_pose_line(line);
    if (pose && *pose && (trajectory.empty() || (*pose)->stamp_s > trajectory.back().stamp_s)) {
      SEEKER_ASSERT(seeker::is_finite((*pose)->map_T_base));
      trajectory.push_back(**pose);
    }
    if (const auto relation = seeker::lab::parse_relation_line(line); relation && *relation) {
      relations.push_back(**relation);
    }
  }
  const auto report = seeker::lab::score_relations(trajectory, {}, relations, {});
  SEEKER_ASSERT(!report || report->all.used + report->missed == relations.size());
  const auto self = seeker::lab::score_reference(trajectory, trajectory, 1.0);
  SEEKER_ASSERT(!self || self->used == trajectory.size());
  return 0;
}
