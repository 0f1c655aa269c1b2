#include "server/app/landmarks/landmark_service.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

namespace seeker::app {
namespace {

constexpr std::size_t kMaxWaiting = 16;

api::LandmarkPoint point_of(const localize::Landmark& landmark) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(landmark.covariance(), Eigen::EigenvaluesOnly);
  return {.id = landmark.id,
          .p = landmark.p_map.head<2>(),
          .z_m = landmark.p_map.z(),
          .sigma_m = std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff())),
          .views = static_cast<std::uint32_t>(landmark.seen)};
}

Result<std::vector<api::LandmarkPoint>> points_of(const std::string& name, const LoadedLandmarks& loaded) {
  if (loaded.database->size() > api::kMaxLandmarks) {
    return fail(Errc::kTooLarge, "database '" + name + "' has more than " + std::to_string(api::kMaxLandmarks) +
                                     " landmarks, too many to be sent; copy its file instead");
  }
  std::vector<api::LandmarkPoint> points;
  points.reserve(loaded.database->size());
  for (const localize::Landmark& landmark : loaded.database->landmarks()) {
    points.push_back(point_of(landmark));
  }
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return points;
}

}  // namespace

LandmarkService::LandmarkService(std::shared_ptr<LandmarkLibrary> library)
    : library_(std::move(library)), disk_(kMaxWaiting, "databases of landmarks") {}

template <class T>
void LandmarkService::on_worker(const api::Reply<T>& reply, std::function<Result<T>(LandmarkLibrary&)> work) {
  const Status ok = disk_.post([this, reply, work = std::move(work)] { reply(work(*library_)); });
  if (!ok) {
    reply(tl::unexpected<Error>(ok.error()));
  }
}

Status LandmarkService::may_change(const std::string& name) const {
  if (const std::string in_use = library_->in_use(); !in_use.empty() && name == in_use) {
    return fail(Errc::kRefused,
                "the robot localises by database '" + name + "' and leaves it as it is; exchange the estimator first");
  }
  return {};
}

void LandmarkService::list(const api::Reply<std::vector<api::LandmarkSummary>>& reply) {
  on_worker<std::vector<api::LandmarkSummary>>(reply, [](LandmarkLibrary& library) { return library.list(); });
}

void LandmarkService::inspect(const std::string& name, bool verify, const api::Reply<api::LandmarkSummary>& reply) {
  on_worker<api::LandmarkSummary>(reply, [name, verify](LandmarkLibrary& library) -> Result<api::LandmarkSummary> {
    if (verify) {
      if (const Result<LoadedLandmarks> loaded = library.load(name); !loaded) {
        return tl::unexpected<Error>(loaded.error());
      }
    }
    return library.inspect(name);
  });
}

void LandmarkService::points(const std::string& name, const api::Reply<std::vector<api::LandmarkPoint>>& reply) {
  using Points = std::vector<api::LandmarkPoint>;
  on_worker<Points>(reply, [name](LandmarkLibrary& library) -> Result<Points> {
    const Result<LoadedLandmarks> loaded = library.load(name);
    return loaded ? points_of(name, *loaded) : Result<Points>(tl::unexpected<Error>(loaded.error()));
  });
}

void LandmarkService::change(const std::string& name, const api::Reply<api::LandmarkSummary>& reply,
                             std::function<Result<api::LandmarkSummary>(LandmarkLibrary&)> work) {
  if (const Status free = may_change(name); !free) {
    reply(tl::unexpected<Error>(free.error()));
    return;
  }
  on_worker<api::LandmarkSummary>(reply, std::move(work));
}

void LandmarkService::prune(const std::string& name, int min_views, const api::Reply<api::LandmarkSummary>& reply) {
  change(name, reply, [name, min_views](LandmarkLibrary& library) { return library.prune(name, min_views); });
}

void LandmarkService::revert(const std::string& name, const api::Reply<api::LandmarkSummary>& reply) {
  change(name, reply, [name](LandmarkLibrary& library) { return library.revert(name); });
}

void LandmarkService::remove(const std::string& name, const api::Reply<void>& reply) {
  if (const Status free = may_change(name); !free) {
    reply(free);
    return;
  }
  on_worker<void>(reply, [name](LandmarkLibrary& library) { return library.remove(name); });
}

void LandmarkService::take(const std::filesystem::path& file, const api::UploadEnd& end,
                           const api::Reply<api::LandmarkSummary>& reply) {
  const auto work = [file, end](LandmarkLibrary& library) {
    return library.take(file, end.name, end.replace, end.check_only);
  };
  if (end.check_only) {
    on_worker<api::LandmarkSummary>(reply, work);
  } else {
    change(end.name, reply, work);
  }
}

void LandmarkService::read(const api::FileRead& wish, const api::Reply<api::FilePiece>& reply) {
  on_worker<api::FilePiece>(reply, [this, wish](LandmarkLibrary& library) -> Result<api::FilePiece> {
    const Result<std::filesystem::path> path = library.path_of(wish.name);
    if (!path) {
      return tl::unexpected<Error>(path.error());
    }
    Result<store::OutgoingPiece> piece =
        outgoing_.read(*path, {wish.offset, wish.max_bytes, wish.hash}, [&library, &wish] {
          const Result<LoadedLandmarks> sound = library.load(wish.name);
          return sound ? Status() : Status(tl::unexpected<Error>(sound.error()));
        });
    if (!piece) {
      return tl::unexpected<Error>(piece.error());
    }
    return api::FilePiece{piece->hash, piece->size_bytes, std::move(piece->bytes)};
  });
}

}  // namespace seeker::app
