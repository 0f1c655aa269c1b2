#include "server/app/fleet/piece_files.hpp"

#include <algorithm>
#include <memory>

#include "common/digest/sha256.hpp"
#include "common/files/files.hpp"
#include "common/log/log.hpp"
#include "server/app/fleet/fleet_settings.hpp"

namespace seeker::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPieceSuffix = ".piece";

std::string piece_name(const api::PieceHash& hash) { return digest::to_hex(hash) + kPieceSuffix; }

}  // namespace

Pieces PieceFiles::load(const api::FleetManifest& manifest) const {
  const fs::path folder = folder_ / manifest.robot_id;
  Pieces pieces;
  const auto load_all = [&](const auto& named) {
    for (const auto& one : named) {
      Result<std::vector<std::uint8_t>> piece =
          files::read_file(folder / piece_name(one.hash), api::kMaxFleetPieceBytes);
      if (piece && digest::sha256_of(*piece) == one.hash) {
        pieces[one.hash] = std::make_shared<const std::vector<std::uint8_t>>(std::move(*piece));
      }
    }
  };
  load_all(manifest.nodes);
  load_all(manifest.pictures);
  return pieces;
}

void PieceFiles::keep(const std::string& robot_id, const api::PieceHash& hash, const PieceBytes& bytes) const {
  const fs::path folder = folder_ / robot_id;
  const Status made = files::make_folder(folder);
  if (const Status kept = made ? files::write_file(folder / piece_name(hash), *bytes) : made; !kept) {
    log::warning(kFleetPart, "a piece of '" + robot_id + "' is not kept: " + kept.error().message);
  }
}

void PieceFiles::drop_all_but(const std::string& robot_id, const Pieces& needed) const {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / robot_id, error)) {
    const bool wanted = std::any_of(needed.begin(), needed.end(), [&](const auto& piece) {
      return entry.path().filename() == piece_name(piece.first);
    });
    if (entry.path().extension() == kPieceSuffix && !wanted) {
      fs::remove(entry.path(), error);
    }
  }
}

}  // namespace seeker::app
