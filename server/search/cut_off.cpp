#include "server/search/cut_off.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace seeker::search {
namespace {

std::array<CellIndex, 8> around(CellIndex c) {
  return {CellIndex{c.i + 1, c.j}, {c.i - 1, c.j},     {c.i, c.j + 1},     {c.i, c.j - 1},
          {c.i + 1, c.j + 1},      {c.i + 1, c.j - 1}, {c.i - 1, c.j + 1}, {c.i - 1, c.j - 1}};
}

nav::CellState state_at(const nav::FloorView& view, CellIndex coarse) {
  return view.cost.state(view.cost.frame().cell_of(view.reachable.frame().centre_of(coarse)));
}

/// Takes the connected piece about the seed out of the floor.
std::vector<CellIndex> take_piece(Grid<std::uint8_t>& floor, CellIndex seed) {
  std::vector<CellIndex> piece{seed};
  floor[seed] = 0;
  for (std::size_t k = 0; k < piece.size(); ++k) {
    for (const CellIndex next : around(piece[k])) {
      if (floor.contains(next) && floor[next] != 0) {
        floor[next] = 0;
        piece.push_back(next);
      }
    }
  }
  return piece;
}

/// Cells of the floor that is cut off. Those beside reachable floor are its seam: whether a coarse cell there counts as
/// reachable changes from map to map.
Grid<std::uint8_t> lost_cells(const nav::FloorView& view, const nav::KnownFloor& known) {
  const Grid<std::uint8_t>& reachable = view.reachable;
  Grid<std::uint8_t> lost(reachable.frame(), reachable.width(), reachable.height(), 0);
  const auto is_reachable = [&](CellIndex cell) { return reachable.contains(cell) && reachable[cell] != 0; };
  for (std::size_t k = 0; k < lost.cells().size(); ++k) {
    const CellIndex cell = reachable.cell(k);
    const Point2 p = reachable.frame().centre_of(cell);
    if (!is_reachable(cell) && view.cost.traversable(p) && known.was_reachable(p)) {
      const auto beside = around(cell);
      lost[cell] = std::none_of(beside.begin(), beside.end(), is_reachable) ? 1 : 0;
    }
  }
  return lost;
}

bool worth_a_wait(const std::vector<CellIndex>& piece, const nav::FloorView& view, const EvidenceGrid& evidence,
                  const WorthAWait& worth) {
  const GridFrame& frame = view.reachable.frame();
  const auto unsearched = std::count_if(piece.begin(), piece.end(), [&](CellIndex cell) {
    return evidence.probability_at(frame.centre_of(cell)) < evidence.params().threshold;
  });
  const auto border = std::count_if(piece.begin(), piece.end(), [&](CellIndex cell) {
    const auto cells = around(cell);
    return std::any_of(cells.begin(), cells.end(),
                       [&](CellIndex next) { return state_at(view, next) == nav::CellState::kUnknown; });
  });
  const double cell_m = frame.resolution_m;
  return static_cast<double>(unsearched) * cell_m * cell_m >= worth.unsearched_m2 ||
         static_cast<double>(border) * cell_m >= worth.border_m;
}

/// The middle of the path that led at some time from the piece to floor that can be reached now. A piece without such a
/// path lies where the map was corrected, and the result is a place on it.
Point2 middle_of_path(const std::vector<CellIndex>& piece, const nav::FloorView& view, const nav::KnownFloor& known) {
  const GridFrame& frame = view.reachable.frame();
  Grid<std::uint8_t> seen(frame, view.reachable.width(), view.reachable.height(), 0);
  std::vector<CellIndex> open = piece;
  for (const CellIndex cell : piece) {
    seen[cell] = 1;
  }
  std::vector<std::size_t> before(piece.size());  // of each open cell: the one it was found from
  for (std::size_t k = 0; k < open.size(); ++k) {
    for (const CellIndex next : around(open[k])) {
      if (!seen.contains(next) || seen[next] != 0) {
        continue;
      }
      seen[next] = 1;
      if (view.reachable[next] != 0) {
        std::vector<std::size_t> path{k};
        while (path.back() >= piece.size()) {
          path.push_back(before[path.back()]);
        }
        return frame.centre_of(open[path[path.size() / 2]]);
      }
      if (known.was_reachable(frame.centre_of(next))) {
        open.push_back(next);
        before.push_back(k);
      }
    }
  }
  return frame.centre_of(piece[piece.size() / 2]);
}

}  // namespace

Grid<std::uint8_t> floor_to_search(const nav::FloorView& view, const nav::KnownFloor& known) {
  Grid<std::uint8_t> floor = lost_cells(view, known);
  for (std::size_t k = 0; k < floor.cells().size(); ++k) {
    floor.cells()[k] = view.reachable.cells()[k] != 0 ? 1 : floor.cells()[k];
  }
  return floor;
}

std::vector<nav::BlockedPlace> blocked_places(const nav::FloorView& view, const nav::KnownFloor& known,
                                              const EvidenceGrid& evidence, const WorthAWait& worth) {
  Grid<std::uint8_t> lost = lost_cells(view, known);
  std::vector<nav::BlockedPlace> places;
  for (std::size_t k = 0; k < lost.cells().size(); ++k) {
    if (lost.cells()[k] == 0) {
      continue;
    }
    const std::vector<CellIndex> piece = take_piece(lost, lost.cell(k));
    if (worth_a_wait(piece, view, evidence, worth)) {
      places.push_back({middle_of_path(piece, view, known), true});
    }
  }
  return places;
}

}  // namespace seeker::search
