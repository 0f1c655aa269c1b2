#include "server/tour/rooms.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "server/nav/flood.hpp"
#include "server/tour/nearest_cell.hpp"

namespace seeker::tour {
namespace {

constexpr std::array<CellIndex, 4> kSides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

CellIndex next_to(CellIndex cell, CellIndex step) { return {cell.i + step.i, cell.j + step.j}; }

/// Numbers the connected parts of the cells that `is_part` takes; 0 elsewhere. More parts than numbers stay 0.
template <class IsPart>
std::uint16_t number_parts(Grid<std::uint16_t>& parts, std::uint16_t last, const IsPart& is_part) {
  for (std::size_t k = 0; k < parts.cells().size(); ++k) {
    const CellIndex seed = parts.cell(k);
    if (parts[seed] != 0 || !is_part(seed) || last == std::numeric_limits<std::uint16_t>::max()) {
      continue;
    }
    parts[seed] = ++last;
    nav::flood(seed, [&](CellIndex next) {
      const bool is_new = parts.contains(next) && parts[next] == 0 && is_part(next);
      if (is_new) {
        parts[next] = last;
      }
      return is_new;
    });
  }
  return last;
}

/// Every floor cell joins the wide part from which the fewest cells lead to it.
void grow(Grid<std::uint16_t>& parts, const Grid<std::uint8_t>& floor) {
  std::vector<CellIndex> ring;
  for (std::size_t k = 0; k < parts.cells().size(); ++k) {
    if (parts.cells()[k] != 0) {
      ring.push_back(parts.cell(k));
    }
  }
  while (!ring.empty()) {
    std::vector<CellIndex> next_ring;
    for (const CellIndex cell : ring) {
      for (const CellIndex step : kSides) {
        const CellIndex next = next_to(cell, step);
        if (floor.contains(next) && floor[next] != 0 && parts[next] == 0) {
          parts[next] = parts[cell];
          next_ring.push_back(next);
        }
      }
    }
    ring = std::move(next_ring);
  }
}

using Borders = std::map<std::pair<std::uint16_t, std::uint16_t>, std::vector<CellIndex>>;

/// Cells at which two parts touch, by the pair of their numbers, the lower one first.
Borders borders_of(const Grid<std::uint16_t>& parts) {
  Borders borders;
  for (std::size_t k = 0; k < parts.cells().size(); ++k) {
    const CellIndex cell = parts.cell(k);
    for (const CellIndex step : {CellIndex{1, 0}, CellIndex{0, 1}}) {
      const CellIndex next = next_to(cell, step);
      if (parts.contains(next) && parts[cell] != 0 && parts[next] != 0 && parts[cell] != parts[next]) {
        borders[std::minmax(parts[cell], parts[next])].push_back(cell);
      }
    }
  }
  return borders;
}

/// The room that each part ends up in, numbered like its largest member: small parts join the neighbour with the
/// longest border, the smallest first.
std::vector<std::uint16_t> joined(const Grid<std::uint16_t>& parts, std::uint16_t last, double least_cells) {
  std::vector<double> sizes(static_cast<std::size_t>(last) + 1, 0.0);
  for (const std::uint16_t part : parts.cells()) {
    sizes[part] += 1.0;
  }
  std::map<std::pair<std::uint16_t, std::uint16_t>, std::size_t> lengths;
  for (const auto& [pair, cells] : borders_of(parts)) {
    lengths[pair] = cells.size();
  }
  std::vector<std::uint16_t> room(sizes.size());
  std::iota(room.begin(), room.end(), std::uint16_t{0});
  std::vector<std::uint16_t> order(room.begin() + 1, room.end());
  std::stable_sort(order.begin(), order.end(), [&](std::uint16_t a, std::uint16_t b) { return sizes[a] < sizes[b]; });
  for (const std::uint16_t part : order) {
    if (sizes[part] >= least_cells) {
      continue;
    }
    std::map<std::uint16_t, std::size_t> beside;
    for (const auto& [pair, length] : lengths) {
      const std::uint16_t a = room[pair.first];
      const std::uint16_t b = room[pair.second];
      if (a != b && (a == part || b == part)) {
        beside[a == part ? b : a] += length;
      }
    }
    const auto longest = std::max_element(beside.begin(), beside.end(),
                                          [](const auto& a, const auto& b) { return a.second < b.second; });
    if (longest != beside.end()) {
      const std::uint16_t into = longest->first;
      sizes[into] += sizes[part];
      std::replace(room.begin(), room.end(), part, into);
    }
  }
  return room;
}

}  // namespace

Rooms Rooms::find(const Grid<std::uint8_t>& floor, const Grid<float>& clearance_m, const RoomsParams& params) {
  Rooms found;
  found.rooms_ = Grid<std::uint16_t>(floor.frame(), floor.width(), floor.height(), kNone);
  const auto wide = static_cast<float>(params.door_half_m);
  std::uint16_t last =
      number_parts(found.rooms_, 0, [&](CellIndex c) { return floor[c] != 0 && clearance_m[c] >= wide; });
  grow(found.rooms_, floor);
  last = number_parts(found.rooms_, last, [&](CellIndex c) { return floor[c] != 0; });
  const double cell_m2 = floor.frame().resolution_m * floor.frame().resolution_m;
  const std::vector<std::uint16_t> room = joined(found.rooms_, last, params.least_room_m2 / cell_m2);
  std::vector<std::uint16_t> number(room.size(), kNone);
  std::uint16_t count = 0;
  for (std::uint16_t& cell : found.rooms_.cells()) {
    if (cell != kNone) {
      std::uint16_t& of_room = number[room[cell]];
      of_room = of_room == kNone ? ++count : of_room;
      cell = of_room;
    }
  }
  found.neighbours_.resize(count);
  for (const auto& [pair, cells] : borders_of(found.rooms_)) {
    found.neighbours_[pair.first - std::size_t{1}].push_back(pair.second);
    found.neighbours_[pair.second - std::size_t{1}].push_back(pair.first);
  }
  return found;
}

std::vector<int> Rooms::passages_from(std::uint16_t room) const {
  std::vector<int> passages(neighbours_.size() + 1, kUnreached);
  if (room == kNone || room > neighbours_.size()) {
    return passages;
  }
  passages[room] = 0;
  std::vector<std::uint16_t> queue{room};
  for (std::size_t k = 0; k < queue.size(); ++k) {
    const std::uint16_t at = queue[k];
    for (const std::uint16_t next : neighbours_[at - std::size_t{1}]) {
      if (passages[next] == kUnreached) {
        passages[next] = passages[at] + 1;
        queue.push_back(next);
      }
    }
  }
  return passages;
}

std::uint16_t Rooms::at(const Point2& p_map) const {
  const std::optional<CellIndex> cell = nearest_cell(rooms_, p_map);
  return cell ? rooms_[*cell] : kNone;
}

}  // namespace seeker::tour
