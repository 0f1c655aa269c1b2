/// \file
/// Input and output of the recognisers: targets, sightings, and the counts of every stage (spec S3.4).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/result.hpp"
#include "common/core/solid.hpp"

namespace seeker::vision {

/// Axis-aligned box of pixels; covers columns [left, left + width) and rows [top, top + height).
struct PixelBox {
  int left_px = 0;
  int top_px = 0;
  int width_px = 0;
  int height_px = 0;

  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

/// Size of an object in the picture: across (tangential in an omnidirectional picture) and up (radial).
struct PixelSize {
  double width_px = 0.0;
  double height_px = 0.0;

  friend bool operator==(const PixelSize&, const PixelSize&) = default;
};

/// Method of recognition of a target, chosen per target.
enum class TargetKind : std::uint8_t {
  kTemplate,  ///< dynamic template matching, spec S3.4: cheap, for pictures of strong contrast that face the robot
  kFeature,   ///< SIFT and a homography: more expensive, for textured pictures, also oblique or partly hidden
  kSolid,     ///< a solid by its shape, spec S6 (server/vision/solids)
};
[[nodiscard]] std::string_view to_string(TargetKind kind);

/// A target to search for. The picture shows the target upright and fills it from edge to edge; a solid has none.
struct TargetModel {
  std::string name;
  Image picture;          ///< grey or colour
  double width_m = 0.30;  ///< size of the real object
  double height_m = 0.30;
  TargetKind kind = TargetKind::kTemplate;
  SolidKind solid = SolidKind::kSphere;  ///< shape of a target of kind kSolid

  friend bool operator==(const TargetModel&, const TargetModel&) = default;
};

/// A target recognised in one picture.
struct Sighting {
  int target = 0;     ///< index into the list of models given to the recogniser
  double u_px = 0.0;  ///< column and row of the target's centre in the original picture
  double v_px = 0.0;
  double score = 0.0;         ///< 0 to 1: grey-level NCC (templates) or share of matches that agree (features)
  double verify_score = 0.0;  ///< NCC of the grey-level gradients (templates) or inliers (features)
  PixelBox box;               ///< encloses the target in the original picture
  /// Rotation of the target's "up" from the picture's "up", counter-clockwise in the picture.
  double rotation_rad = 0.0;
  /// The bearing alpha' of spec S3.5, eq (4): left positive, 0 = forward. In a photograph it follows from the
  /// horizontal field of view in the parameters, 0 at the middle column.
  double bearing_base_rad = 0.0;
  std::optional<double> elevation_rad;  ///< of the centre above the camera's horizon; omnidirectional pictures only
  std::optional<double> range_m;  ///< estimate from the apparent and the real size; about 15 %; never a measurement
  /// Range of the middle of an object on the floor, from the camera's height and the point where the picture shows the
  /// floor before it.
  std::optional<double> floor_range_m;
  PixelSize size;  ///< apparent size: across and up, in pixels of the original picture

  friend bool operator==(const Sighting&, const Sighting&) = default;
};

/// Numbers of candidates that each stage processed and rejected, summed over targets. The stages are in the order of
/// S3.4.
struct StageCounts {
  int regions = 0;             ///< connected regions of all binarisations and both polarities
  int rejected_area = 0;       ///< area outside 0.05 % .. 20 % of the picture
  int rejected_duplicate = 0;  ///< same box as a region of another binarisation
  int rejected_aspect = 0;     ///< (region, target) pairs whose proportions differ by more than 25 %
  int candidates = 0;          ///< (region, target) pairs that were correlated
  int rejected_ncc = 0;        ///< correlation below the threshold
  int rejected_verify = 0;     ///< rejected by the gradient check
  int rejected_overlap = 0;    ///< another sighting has a higher score: at the same position, or of those wanted
  int features = 0;            ///< key points in the scene (feature recogniser)
  int matches = 0;             ///< mutual matches after the ratio test (feature recogniser)
  int rejected_geometry = 0;   ///< no plausible homography, or too few inliers (feature recogniser)
  int accepted = 0;

  StageCounts& operator+=(const StageCounts& other);
  friend bool operator==(const StageCounts&, const StageCounts&) = default;
};

/// All results of one picture, best score first.
struct RecognitionReport {
  std::vector<Sighting> sightings;
  StageCounts stages;

  friend bool operator==(const RecognitionReport&, const RecognitionReport&) = default;
};

/// One stage of the processing as a picture (Fig 4 of the search paper).
struct StageImage {
  std::string name;  ///< lower case with underscores, usable as a file name
  Image image;
};

/// Recognises targets in pictures. The same picture gives the same report: no state, no random numbers. Thread-safe.
class Recogniser {
 public:
  Recogniser() = default;
  Recogniser(const Recogniser&) = delete;
  Recogniser& operator=(const Recogniser&) = delete;
  virtual ~Recogniser() = default;

  /// Fails with kInvalidArgument when the picture is empty, or its size differs from that of the camera's calibration.
  [[nodiscard]] virtual Result<RecognitionReport> recognise(const Image& picture) const = 0;
  /// The stages of the same processing as pictures, in their order.
  [[nodiscard]] virtual Result<std::vector<StageImage>> explain(const Image& picture) const = 0;
};

}  // namespace seeker::vision
