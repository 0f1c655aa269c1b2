#include <sstream>

#include "client/cli/exit_code.hpp"
#include "client/cli/targets.hpp"
#include "common/config/yaml.hpp"
#include "common/core/number_in.hpp"

namespace seeker::cli {
namespace {

/// A polygon's file: a bare YAML list, read below a key since documents are maps.
struct PolygonFile {
  Polygon corners;
};

void describe(config::Fields& f, PolygonFile& file) { f.field("corners", file.corners); }

Result<Polygon> read_polygon_file(const std::string& path) {
  const Result<std::string> text = config::read_text_file(path);
  if (!text) {
    return tl::unexpected<Error>(text.error());
  }
  // Indented below a key, on the same lines, so that line numbers in messages stay true.
  std::string document = "corners:";
  std::istringstream lines(*text);
  for (std::string line; std::getline(lines, line);) {
    document += " " + line + "\n";
  }
  const Result<config::Document> parsed = config::Document::parse(document, path);
  if (!parsed) {
    return tl::unexpected<Error>(parsed.error());
  }
  PolygonFile file;
  if (const Status ok = parsed->read(file); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return file.corners;
}

}  // namespace

Result<Point2> parse_point(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma != std::string::npos) {
    const auto x = finite_in(std::string_view(text).substr(0, comma));
    const auto y = finite_in(std::string_view(text).substr(comma + 1));
    if (x && y) {
      return Point2(*x, *y);
    }
  }
  return fail(Errc::kInvalidArgument, "'" + text + "' is no point; write x,y in metres, as in 3,4.5");
}

Result<Polygon> parse_polygon(const std::string& text) {
  Polygon polygon;
  if (text.starts_with('@')) {
    Result<Polygon> file = read_polygon_file(text.substr(1));
    if (!file) {
      return fail_as_usage(file.error());
    }
    polygon = std::move(*file);
  } else {
    std::istringstream words(text);
    for (std::string word; words >> word;) {
      const Result<Point2> corner = parse_point(word);
      if (!corner) {
        return tl::unexpected<Error>(corner.error());
      }
      polygon.push_back(*corner);
    }
  }
  if (const Status ok = validate_polygon(polygon); !ok) {
    return fail_with_context("'" + text + "'", ok.error());
  }
  return polygon;
}

Result<Duration> parse_duration(const std::string& text) {
  constexpr double kLongest_s = 30.0 * 24.0 * 3600.0;
  struct Unit {
    std::string_view name;
    double seconds;
  };
  for (const Unit& unit : {Unit{"ms", 1e-3}, Unit{"min", 60.0}, Unit{"s", 1.0}, Unit{"h", 3600.0}, Unit{"", 1.0}}) {
    if (!text.ends_with(unit.name)) {
      continue;
    }
    const auto number = finite_in(std::string_view(text).substr(0, text.size() - unit.name.size()));
    if (number && *number > 0.0 && *number * unit.seconds <= kLongest_s) {
      return seconds(*number * unit.seconds);
    }
  }
  return fail(Errc::kInvalidArgument, "'" + text + "' is no duration; write 300s, 5min, 1h or 200ms");
}

Result<LinkChoice> parse_link_policy(const std::string& text) {
  for (const auto policy :
       {api::LinkPolicy::kStop, api::LinkPolicy::kFinishStep, api::LinkPolicy::kContinue, api::LinkPolicy::kReturn}) {
    if (text == to_string(policy)) {
      return LinkChoice{policy, {}};
    }
  }
  Result<api::LinkSteps> steps = api::parse_link_steps(text);
  return steps ? Result<LinkChoice>(LinkChoice{api::LinkPolicy::kStop, std::move(*steps)})
               : tl::unexpected<Error>(steps.error());
}

api::OnFound parse_on_found(const std::string& name) {
  for (const auto on_found : {api::OnFound::kStop, api::OnFound::kContinue}) {
    if (name == to_string(on_found)) {
      return on_found;
    }
  }
  return api::OnFound::kApproach;
}

api::SearchMode parse_search_mode(const std::string& name) {
  return name == to_string(api::SearchMode::kPaper) ? api::SearchMode::kPaper : api::SearchMode::kPlan;
}

api::ExploreStrategy parse_explore_strategy(const std::string& name) {
  for (const api::ExploreStrategy strategy : api::kExploreStrategies) {
    if (name == to_string(strategy)) {
      return strategy;
    }
  }
  return api::kDefaultExploreStrategy;
}

}  // namespace seeker::cli
