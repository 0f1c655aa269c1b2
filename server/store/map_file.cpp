#include "server/store/map_file.hpp"

#include <algorithm>
#include <array>

#include "common/files/files.hpp"
#include "server/store/map_file_bytes.hpp"
#include "server/store/pack.hpp"

namespace seeker::store {
namespace {

constexpr std::array<std::uint8_t, 8> kMagic{'S', 'E', 'E', 'K', 'R', 'M', 'A', 'P'};
constexpr std::size_t kCrc_bytes = 4;
// Least bytes of an entry: what a declared count is held against.
constexpr std::size_t kNode_bytes = 4 + 24 + 8;
constexpr std::size_t kEdge_bytes = 4 + 4 + 24 + 72 + 2;
constexpr std::size_t kSegment_bytes = 8 + 4 + 24 + 8 + 2 + 32 + 4 + 16;
constexpr std::size_t kKeyframe_bytes = 4 + 8 + 24 + 24 + 12 + 4;
constexpr std::size_t kRange_bytes = 2;

tl::unexpected<Error> damaged(const std::string& what) {
  return fail(Errc::kCorrupt, "the map file is damaged (" + what + "); take a copy of it, or save the map again");
}

Status check_origin(const MapOrigin& origin) {
  if (Status ok = validate_map_name(origin.name); !ok) {
    return ok;
  }
  for (const std::string* text : {&origin.robot_id, &origin.sensors, &origin.software_version}) {
    if (text->size() > kMaxOriginText) {
      return fail(Errc::kInvalidArgument, "a text about the map is longer than " + std::to_string(kMaxOriginText) +
                                              " bytes; shorten the robot's id");
    }
  }
  return {};
}

MapFileHeader header_of(const MapFile& file) {
  const LineMap& map = file.map;
  MapFileHeader header;
  header.origin = file.origin;
  header.epoch = map.epoch;
  header.nodes = static_cast<std::uint32_t>(map.nodes.size());
  header.edges = static_cast<std::uint32_t>(map.edges.size());
  header.loops = static_cast<std::uint32_t>(
      std::count_if(map.edges.begin(), map.edges.end(), [](const MapEdge& e) { return e.loop && e.enabled; }));
  header.segments = static_cast<std::uint32_t>(map.segments.size());
  header.keyframes = static_cast<std::uint32_t>(map.keyframes.size());
  return header;
}

/// The same order for writing (ByteWriter::put) and reading (ByteReader::get).
template <class Header, class Visit>
void visit_header(Header& h, Visit visit) {
  visit(h.origin.name);
  visit(h.origin.robot_id);
  visit(h.origin.sensors);
  visit(h.origin.software_version);
  visit(h.origin.created_unix_s);
  visit(h.origin.saved_unix_s);
  visit(h.epoch);
  visit(h.nodes);
  visit(h.edges);
  visit(h.loops);
  visit(h.segments);
  visit(h.keyframes);
  visit(h.body_bytes);
  visit(h.frame_bytes);
}

void put_flag(ByteWriter& out, bool flag) { out.put(static_cast<std::uint8_t>(flag ? 1 : 0)); }

void put_graph(ByteWriter& out, const LineMap& map) {
  out.put(map.epoch);
  out.put(map.next_id);
  out.put(static_cast<std::uint32_t>(map.nodes.size()));
  for (const MapNode& node : map.nodes) {
    out.put(node.id);
    out.put(node.map_T_node);
    out.put(node.created);
  }
  out.put(static_cast<std::uint32_t>(map.edges.size()));
  for (const MapEdge& edge : map.edges) {
    out.put(edge.from);
    out.put(edge.to);
    out.put(edge.from_T_to);
    out.put(edge.covariance);
    put_flag(out, edge.loop);
    put_flag(out, edge.enabled);
  }
}

void put_segments(ByteWriter& out, const LineMap& map) {
  out.put(static_cast<std::uint32_t>(map.segments.size()));
  for (const MapSegment& segment : map.segments) {
    out.put(segment.id);
    out.put(segment.node);
    out.put(segment.map_T_segment);
    out.put(segment.length_m);
    put_flag(out, segment.left_real);
    put_flag(out, segment.right_real);
    out.put(segment.covariance);
    out.put(segment.hits);
    out.put(segment.created);
    out.put(segment.last_seen);
  }
}

void put_keyframes(ByteWriter& out, const LineMap& map) {
  out.put(static_cast<std::uint32_t>(map.keyframes.size()));
  for (const MapKeyframe& keyframe : map.keyframes) {
    out.put(keyframe.node);
    out.put(keyframe.stamp);
    out.put(keyframe.node_T_base);
    out.put(keyframe.base_T_laser);
    out.put(keyframe.angle_min_rad);
    out.put(keyframe.angle_step_rad);
    out.put(keyframe.range_max_m);
    out.put(static_cast<std::uint32_t>(keyframe.ranges.size()));
    for (const std::uint16_t range : keyframe.ranges) {
      out.put(range);
    }
  }
}

std::vector<std::uint8_t> body_of(const LineMap& map) {
  ByteWriter out;
  std::size_t size = map.nodes.size() * kNode_bytes + map.edges.size() * kEdge_bytes;
  size += map.segments.size() * kSegment_bytes + map.keyframes.size() * kKeyframe_bytes;
  for (const MapKeyframe& keyframe : map.keyframes) {
    size += keyframe.ranges.size() * kRange_bytes;
  }
  out.reserve(size + sizeof(std::uint64_t) * 4);
  put_graph(out, map);
  put_segments(out, map);
  put_keyframes(out, map);
  return out.take();
}

void get_graph(ByteReader& in, LineMap& map) {
  in.get(map.epoch);
  in.get(map.next_id);
  map.nodes.resize(in.get_count(kNode_bytes));
  for (MapNode& node : map.nodes) {
    in.get(node.id);
    in.get(node.map_T_node);
    in.get(node.created);
  }
  map.edges.resize(in.get_count(kEdge_bytes));
  for (MapEdge& edge : map.edges) {
    in.get(edge.from);
    in.get(edge.to);
    in.get(edge.from_T_to);
    in.get(edge.covariance);
    in.get_flag(edge.loop);
    in.get_flag(edge.enabled);
  }
}

void get_segments(ByteReader& in, LineMap& map) {
  map.segments.resize(in.get_count(kSegment_bytes));
  for (MapSegment& segment : map.segments) {
    in.get(segment.id);
    in.get(segment.node);
    in.get(segment.map_T_segment);
    in.get(segment.length_m);
    in.get_flag(segment.left_real);
    in.get_flag(segment.right_real);
    in.get(segment.covariance);
    in.get(segment.hits);
    in.get(segment.created);
    in.get(segment.last_seen);
  }
}

void get_keyframes(ByteReader& in, LineMap& map) {
  map.keyframes.resize(in.get_count(kKeyframe_bytes));
  for (MapKeyframe& keyframe : map.keyframes) {
    in.get(keyframe.node);
    in.get(keyframe.stamp);
    in.get(keyframe.node_T_base);
    in.get(keyframe.base_T_laser);
    in.get(keyframe.angle_min_rad);
    in.get(keyframe.angle_step_rad);
    in.get(keyframe.range_max_m);
    keyframe.ranges.resize(in.get_count(kRange_bytes));
    for (std::uint16_t& range : keyframe.ranges) {
      in.get(range);
    }
  }
}

struct HeaderAndFrame {
  MapFileHeader header;
  std::size_t frame_at = 0;  ///< where the body's frame begins
};

Result<HeaderAndFrame> read_header(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kMagic.size() || !std::equal(kMagic.begin(), kMagic.end(), bytes.begin())) {
    return fail(Errc::kParse,
                "this is not a map file of Seeker; give one that 'seeker map save' or 'map download' made");
  }
  ByteReader in(bytes.subspan(kMagic.size()));
  std::uint32_t version = 0;
  std::uint32_t size = 0;
  in.get(version);
  in.get(size);
  if (in.ok() && version > kMapFileVersion) {
    return fail(Errc::kUnsupportedVersion, "the map file has format " + std::to_string(version) +
                                               ", this program knows formats up to " + std::to_string(kMapFileVersion) +
                                               "; update this program");
  }
  const std::span<const std::uint8_t> header_bytes = in.take(size);
  const std::size_t covered = bytes.size() - in.left();
  std::uint32_t crc = 0;
  in.get(crc);
  if (!in.ok() || version == 0 || crc != crc32(bytes.first(covered))) {
    return damaged("its header is cut or altered");
  }
  HeaderAndFrame out;
  ByteReader header(header_bytes);
  visit_header(out.header, [&](auto& field) { header.get(field); });
  if (!header.ok() || header.left() != 0) {
    return damaged("its header does not follow the format");
  }
  if (const Status ok = check_origin(out.header.origin); !ok) {
    return damaged(ok.error().message);
  }
  out.frame_at = covered + kCrc_bytes;
  return out;
}

Result<LineMap> read_body(std::span<const std::uint8_t> body) {
  LineMap map;
  ByteReader in(body);
  get_graph(in, map);
  get_segments(in, map);
  get_keyframes(in, map);
  if (!in.ok() || in.left() != 0) {
    return damaged("its content does not follow the format");
  }
  if (const Status ok = validate(map); !ok) {
    return damaged(ok.error().message);
  }
  return map;
}

}  // namespace

std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  static constexpr auto kTable = [] {
    constexpr std::uint32_t kPolynomial = 0xEDB88320U;
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t k = 0; k < table.size(); ++k) {
      std::uint32_t value = k;
      for (int bit = 0; bit < 8; ++bit) {
        value = (value & 1U) != 0 ? (value >> 1U) ^ kPolynomial : value >> 1U;
      }
      table[k] = value;
    }
    return table;
  }();
  std::uint32_t crc = ~0U;
  for (const std::uint8_t byte : bytes) {
    crc = (crc >> 8U) ^ kTable[(crc ^ byte) & 0xFFU];
  }
  return ~crc;
}

Result<std::vector<std::uint8_t>> encode_map_file(const MapFile& file, const MapFileLimits& limits) {
  Status ok = check_origin(file.origin);
  ok = ok ? validate(file.map) : ok;
  if (!ok) {
    return tl::unexpected<Error>(ok.error());
  }
  const std::vector<std::uint8_t> body = body_of(file.map);
  if (body.size() > limits.body_bytes) {
    return fail(Errc::kTooLarge, "the map takes " + std::to_string(body.size()) + " bytes, more than the " +
                                     std::to_string(limits.body_bytes) + " of a map file");
  }
  const Result<std::vector<std::uint8_t>> frame = pack(body);
  if (!frame) {
    return frame;
  }
  MapFileHeader header = header_of(file);
  header.body_bytes = body.size();
  header.frame_bytes = frame->size();
  ByteWriter header_bytes;
  visit_header(header, [&](const auto& field) { header_bytes.put(field); });
  ByteWriter out;
  out.put(std::span<const std::uint8_t>(kMagic));
  out.put(kMapFileVersion);
  out.put(static_cast<std::uint32_t>(header_bytes.bytes().size()));
  out.put(std::span<const std::uint8_t>(header_bytes.bytes()));
  out.put(crc32(out.bytes()));
  out.put(std::span<const std::uint8_t>(*frame));
  out.put(crc32(out.bytes()));
  return out.take();
}

Result<MapFileHeader> decode_map_header(std::span<const std::uint8_t> bytes) {
  Result<HeaderAndFrame> read = read_header(bytes);
  if (!read) {
    return tl::unexpected<Error>(read.error());
  }
  return std::move(read->header);
}

Result<MapFile> decode_map_file(std::span<const std::uint8_t> bytes, const MapFileLimits& limits) {
  if (bytes.size() > limits.file_bytes) {
    return fail(Errc::kTooLarge, "the map file has " + std::to_string(bytes.size()) +
                                     " bytes, more than the limit of " + std::to_string(limits.file_bytes));
  }
  Result<HeaderAndFrame> read = read_header(bytes);
  if (!read) {
    return tl::unexpected<Error>(read.error());
  }
  const MapFileHeader& header = read->header;
  ByteReader in(bytes.subspan(read->frame_at));
  const std::span<const std::uint8_t> frame = in.take(header.frame_bytes);
  const std::size_t covered = bytes.size() - in.left();
  std::uint32_t crc = 0;
  in.get(crc);
  if (!in.ok() || in.left() != 0 || crc != crc32(bytes.first(covered))) {
    return damaged("its content is cut or altered");
  }
  const Result<std::vector<std::uint8_t>> body =
      unpack(frame, std::min<std::size_t>(limits.body_bytes, header.body_bytes));
  if (!body) {
    return damaged(body.error().message);
  }
  Result<LineMap> map = read_body(*body);
  if (!map) {
    return tl::unexpected<Error>(map.error());
  }
  MapFile file{header.origin, std::move(*map)};
  MapFileHeader actual = header_of(file);
  actual.body_bytes = body->size();
  actual.frame_bytes = frame.size();
  if (actual != header) {
    return damaged("header and content do not belong together");
  }
  return file;
}

Status write_map_file(const std::filesystem::path& path, const MapFile& file) {
  const Result<std::vector<std::uint8_t>> bytes = encode_map_file(file);
  return bytes ? files::write_file(path, *bytes) : Status(tl::unexpected<Error>(bytes.error()));
}

Result<MapFile> read_map_file(const std::filesystem::path& path, const MapFileLimits& limits) {
  const Result<std::vector<std::uint8_t>> bytes = files::read_file(path, limits.file_bytes);
  if (!bytes) {
    return tl::unexpected<Error>(bytes.error());
  }
  Result<MapFile> file = decode_map_file(*bytes, limits);
  return file ? std::move(file) : fail_with_context("'" + path.string() + "'", file.error());
}

}  // namespace seeker::store
