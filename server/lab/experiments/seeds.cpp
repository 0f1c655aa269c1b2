#include "server/lab/experiments/seeds.hpp"

#include <algorithm>

#include "common/core/number_in.hpp"

namespace seeker::lab {
namespace {

constexpr std::size_t kMaxSeeds = 10'000;

}  // namespace

Result<std::vector<std::uint64_t>> parse_seeds(const std::string& text) {
  std::vector<std::uint64_t> seeds;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view part = std::string_view(text).substr(begin, end - begin);
    const std::size_t dash = part.find('-');
    const std::optional<std::uint64_t> first = number_in<std::uint64_t>(part.substr(0, dash));
    const std::optional<std::uint64_t> last =
        dash == std::string_view::npos ? first : number_in<std::uint64_t>(part.substr(dash + 1));
    if (!first || !last || *last < *first || *last - *first >= kMaxSeeds || seeds.size() >= kMaxSeeds) {
      return fail(
          Errc::kInvalidArgument,
          "seeds '" + text + "': write numbers and ranges such as 1-20 or 1-3,7; at most " + std::to_string(kMaxSeeds));
    }
    for (std::uint64_t seed = *first; seed <= *last; ++seed) {
      seeds.push_back(seed);
    }
    begin = end + 1;
  }
  std::sort(seeds.begin(), seeds.end());
  seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
  return seeds;
}

std::string print_seeds(std::vector<std::uint64_t> seeds) {
  std::sort(seeds.begin(), seeds.end());
  seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
  std::string text;
  for (std::size_t i = 0; i < seeds.size();) {
    std::size_t last = i;
    while (last + 1 < seeds.size() && seeds[last + 1] == seeds[last] + 1) {
      ++last;
    }
    text += (text.empty() ? "" : ",") + std::to_string(seeds[i]);
    if (last > i) {
      text += "-" + std::to_string(seeds[last]);
    }
    i = last + 1;
  }
  return text;
}

}  // namespace seeker::lab
