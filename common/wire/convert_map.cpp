#include "common/wire/convert.hpp"
#include "common/wire/zstd.hpp"

namespace seeker::wire {

void write(const OccupancyTile& from, pb::Tile* to) {
  to->set_i(from.index.i);
  to->set_j(from.index.j);
  to->set_revision(from.revision);
  to->set_cells_zstd(compress(from.cells));
}

void read(const pb::Tile& from, OccupancyTile& to, Check& check) {
  if (from.i() < -kMaxTileIndex || from.i() > kMaxTileIndex || from.j() < -kMaxTileIndex || from.j() > kMaxTileIndex) {
    check.refuse("i", Errc::kInvalidArgument, "or j is too far from the origin");
    return;
  }
  to.index = {from.i(), from.j()};
  to.revision = from.revision();
  if (const Status unpacked = decompress(from.cells_zstd(), to.cells); !unpacked) {
    check.refuse("cells_zstd", unpacked.error().code, unpacked.error().message);
  }
}

void write(const api::TileUpdate& from, pb::TileUpdate* to) {
  to->set_revision(from.revision);
  to->set_map_epoch(from.map_epoch);
  for (const OccupancyTile& tile : from.tiles) {
    write(tile, to->add_tiles());
  }
}

void read(const pb::TileUpdate& from, api::TileUpdate& to, Check& check) {
  if (!check.count("tiles", static_cast<std::size_t>(from.tiles_size()), kMaxTilesPerUpdate)) {
    return;
  }
  to.revision = from.revision();
  to.map_epoch = from.map_epoch();
  to.tiles.resize(static_cast<std::size_t>(from.tiles_size()));
  for (std::size_t k = 0; k < to.tiles.size() && check.ok(); ++k) {
    const auto scope = check.in("tiles", k);
    read(from.tiles(static_cast<int>(k)), to.tiles[k], check);
  }
}

}  // namespace seeker::wire
