/// \file
/// Scores as texts for people and as JSON.
#pragma once

#include <string>

#include "server/lab/scoring/score_reference.hpp"
#include "server/lab/scoring/score_relations.hpp"

namespace seeker::lab {

[[nodiscard]] std::string relation_text(const RelationReport& report);
[[nodiscard]] std::string relation_json(const RelationReport& report);
[[nodiscard]] std::string reference_text(const ReferenceReport& report);
[[nodiscard]] std::string reference_json(const ReferenceReport& report);

/// One sentence about what was skipped in a file; empty where all of it was used.
[[nodiscard]] std::string complaints(const std::string& file, const drivers::BadLines& bad, const std::string& damage);

}  // namespace seeker::lab
