#include "client/cli/transfer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "client/values/values.hpp"
#include "common/digest/sha256.hpp"
#include "common/files/file_pieces.hpp"
#include "common/image/png.hpp"
#include "common/rpc/file_transfer.hpp"

namespace seeker::cli {
namespace {

namespace fs = std::filesystem;

/// Pixels of a picture, in bytes, from which on it goes ahead of the request, once, by its hash.
constexpr std::size_t kLargePicture_bytes = std::size_t{64} << 10U;
/// Digits of the hash in the name of a file that is on its way.
constexpr std::size_t kNameDigits = 16;
constexpr std::string_view kPartEnding = ".part";

/// One line on a terminal, which goes when the transfer ends.
class Progress {
 public:
  Progress(const Context& context, std::string verb)
      : context_(context), verb_(std::move(verb)), shown_(context.err_is_tty && !context.quiet) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() {
    if (shown_) {
      *context_.err << "\r\x1b[K" << std::flush;
    }
  }
  void show(std::uint64_t done, std::uint64_t size) {
    constexpr double kPercent = 100.0;
    const double part = static_cast<double>(done) / static_cast<double>(std::max<std::uint64_t>(size, 1));
    const int percent = static_cast<int>(std::floor(kPercent * part));
    if (shown_ && percent != percent_) {
      percent_ = percent;
      *context_.err << "\r\x1b[K" << verb_ << ' ' << size_of(done) << " of " << size_of(size) << ", " << percent << " %"
                    << std::flush;
    }
  }

 private:
  const Context& context_;
  std::string verb_;
  bool shown_;
  int percent_ = -1;
};

/// --timeout is for the whole transfer, the link has its own time.
rpc::TransferParams params_of(const Context& context, const std::shared_ptr<Progress>& progress) {
  rpc::TransferParams params;
  const auto begun = std::chrono::steady_clock::now();
  params.broken = [&context, begun]() -> std::optional<Error> {
    if (context.timeout && std::chrono::steady_clock::now() - begun > *context.timeout) {
      return Error{Errc::kTimeout, "the file did not arrive in the time of --timeout"};
    }
    return broken(context);
  };
  params.on_progress = [progress](std::uint64_t done, std::uint64_t size) { progress->show(done, size); };
  return params;
}

Error with_remedy(Error error) {
  if (error.code == Errc::kLinkLost || error.code == Errc::kTimeout || error.code == Errc::kCancelled) {
    error.message += "; the same command goes on from there";
  }
  return error;
}

/// The file of an earlier attempt, where that was of this hash; those of other hashes are of no use any more.
fs::path part_of(const Context& context, const fs::path& to, const api::FileHash& hash) {
  const fs::path part = to.string() + "." + digest::to_hex(hash).substr(0, kNameDigits) + std::string(kPartEnding);
  const fs::path folder = to.parent_path().empty() ? fs::path(".") : to.parent_path();
  const std::string start = to.filename().string() + ".";
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool is_part = name.size() == start.size() + kNameDigits + kPartEnding.size() && name.starts_with(start) &&
                         name.ends_with(kPartEnding);
    if (is_part && name != part.filename().string()) {
      say(context, "the file has changed since an earlier download began, which is given up");
      std::error_code ignored;
      fs::remove(entry.path(), ignored);
    }
  }
  return part;
}

std::uint64_t bytes_in(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  return error ? 0 : size;
}

/// Puts what has arrived in its place when it is what was announced.
Status take_into_place(const fs::path& part, const fs::path& to, const api::FileHash& hash) {
  const Result<digest::Sha256Sum> sum = digest::sha256_of_file(part);
  if (!sum) {
    return tl::unexpected<Error>(sum.error());
  }
  if (*sum != hash) {
    std::error_code error;
    fs::remove(part, error);
    return fail(Errc::kCorrupt, "what has arrived is not what the robot announced; download it again");
  }
  return files::put_in_place(part, to);
}

/// That the file is damaged is said by the robot, which alone can read it; its own disk may fail too.
tl::unexpected<Error> refused_by_robot(const Error& error) {
  return error.code == Errc::kCorrupt ? fail_as_usage(error) : tl::unexpected<Error>(with_remedy(error));
}

/// kUnsupportedVersion and kNotReady say that the robot takes no pictures.
Status send_picture(const Context& context, api::TargetSpec& target) {
  const Result<std::vector<std::uint8_t>> png = image::encode_png(target.picture);
  if (!png) {
    return tl::unexpected<Error>(png.error());
  }
  const api::FileHash hash = digest::sha256_of(*png);
  rpc::FileTransfer transfer(context.robot,
                             params_of(context, std::make_shared<Progress>(context, "sending " + target.name)));
  const Status sent =
      transfer.send({api::FileKind::kPicture, hash, png->size()}, [&](std::uint64_t offset, std::size_t n) {
        const auto from = png->begin() + static_cast<std::ptrdiff_t>(offset);
        const auto left = png->size() - static_cast<std::size_t>(offset);
        return Result<std::vector<std::uint8_t>>(
            std::vector<std::uint8_t>(from, from + static_cast<std::ptrdiff_t>(std::min(n, left))));
      });
  if (!sent) {
    return sent;
  }
  const Result<api::UploadedFile> kept = transfer.finish({api::FileKind::kPicture, hash, "", false, false});
  if (!kept) {
    return fail(kept.error().code == Errc::kUnsupportedVersion ? Errc::kInternal : kept.error().code,
                kept.error().message);
  }
  target.picture = Image();
  target.picture_hash = hash;
  return {};
}

}  // namespace

Result<api::UploadedFile> send_file(const Context& context, const fs::path& file, api::UploadEnd end, bool& too_old) {
  const Result<files::FileReader> reader = files::FileReader::open(file);
  const Result<digest::Sha256Sum> sum =
      reader ? digest::sha256_of_file(file) : Result<digest::Sha256Sum>(tl::unexpected<Error>(reader.error()));
  const Result<files::FileIdentity> identity =
      sum ? reader->identity() : Result<files::FileIdentity>(tl::unexpected<Error>(sum.error()));
  if (!identity) {
    return fail_as_usage(identity.error());
  }
  end.hash = *sum;
  const api::FileOffer offer{end.kind, *sum, identity->size_bytes};
  if (const Status valid = api::validate(offer); !valid) {
    return fail_with_context(file.string(), valid.error());
  }
  rpc::FileTransfer transfer(context.robot, params_of(context, std::make_shared<Progress>(context, "sent")));
  const Status sent =
      transfer.send(offer, [&](std::uint64_t offset, std::size_t n) { return reader->read(offset, n); });
  if (!sent) {
    too_old = sent.error().code == Errc::kUnsupportedVersion;
    return refused_by_robot(sent.error());
  }
  Result<api::UploadedFile> taken = transfer.finish(end);
  return taken ? std::move(taken) : refused_by_robot(taken.error());
}

Status fetch_file(const Context& context, api::FileKind kind, const std::string& name, const fs::path& to) {
  rpc::FileTransfer transfer(context.robot, params_of(context, std::make_shared<Progress>(context, "fetched")));
  const Result<api::FilePiece> file = transfer.look(kind, name);
  if (!file) {
    return tl::unexpected<Error>(with_remedy(file.error()));
  }
  const fs::path part = part_of(context, to, file->hash);
  const std::uint64_t have = bytes_in(part);
  const Status arrived = transfer.receive({kind, name, have > file->size_bytes ? 0 : have, 0, file->hash}, *file,
                                          [&](std::uint64_t offset, std::span<const std::uint8_t> bytes) {
                                            return files::write_piece(part, offset, bytes);
                                          });
  return arrived ? take_into_place(part, to, file->hash) : Status(tl::unexpected<Error>(with_remedy(arrived.error())));
}

Result<api::MissionRequest> send_pictures(const Context& context, api::MissionRequest request) {
  std::vector<api::TargetSpec>* targets = api::targets_of(request.task);
  if (targets == nullptr) {
    return request;
  }
  for (api::TargetSpec& target : *targets) {
    if (target.picture.data().size() < kLargePicture_bytes) {
      continue;
    }
    if (const Status sent = send_picture(context, target); !sent) {
      if (sent.error().code == Errc::kUnsupportedVersion || sent.error().code == Errc::kNotReady) {
        return request;  // older software, or no folder: what fits into the request goes with it
      }
      return fail_with_context("the picture of target '" + target.name + "'", sent.error());
    }
  }
  return request;
}

}  // namespace seeker::cli
