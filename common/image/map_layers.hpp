/// \file
/// The layers of a map picture, each drawn over the ones before.
#pragma once

#include "common/image/canvas.hpp"
#include "common/image/map_view.hpp"

namespace seeker::image {

/// Looks shared by the map and its legend.
namespace look {
inline constexpr Colour kUnknown{222, 225, 229};
inline constexpr Colour kFree{253, 253, 252};
inline constexpr Colour kWall{30, 34, 42};
inline constexpr double kEvidenceAlpha = 0.42;
inline constexpr Stroke kTrajectory{kBlue, 2.4, LineStyle::kSolid, 0.95};
inline constexpr Stroke kPlan{kPurple, 2.2, LineStyle::kDotted, 0.9};
inline constexpr Stroke kSearched{{0, 110, 120}, 1.3, LineStyle::kSolid, 0.75};
inline constexpr Stroke kUnsearched{kOrange, 1.8, LineStyle::kDashed, 1.0};
inline constexpr Stroke kUnreachable{kRed, 1.8, LineStyle::kSolid, 0.9};
inline constexpr Stroke kSpaceTree{kGreen, 1.3, LineStyle::kSolid, 0.8};
inline constexpr Stroke kBound{kPurple, 2.0, LineStyle::kDashDot, 0.9};
inline constexpr Stroke kKeepOut{kRed, 1.6, LineStyle::kSolid, 0.8};
inline constexpr Colour kTarget{214, 0, 110};
inline constexpr Colour kRobot{0, 72, 140};
inline constexpr Colour kGap{150, 30, 20};
}  // namespace look

void draw_occupancy(Canvas& canvas, const MapView& view, const Grid<std::uint8_t>& occupancy);
void draw_evidence(Canvas& canvas, const MapView& view, const Grid<std::uint8_t>& evidence);
void draw_areas(Canvas& canvas, const MapView& view, const MapScene& scene);
void draw_cells(Canvas& canvas, const MapView& view, const MapScene& scene);
void draw_paths(Canvas& canvas, const MapView& view, const MapScene& scene);
void draw_gaps(Canvas& canvas, const MapView& view, const std::vector<GapMark>& gaps);
void draw_detections(Canvas& canvas, const MapView& view, const std::vector<DetectionMark>& detections);
void draw_robot(Canvas& canvas, const MapView& view, const Pose2& map_T_base, double radius_m);
void draw_scale_bar(Canvas& canvas, const MapView& view);

/// One cell of the lists as drawn on the map and in the legend; `cross` marks what could not be reached.
void draw_cell(Canvas& canvas, const Point2& centre_px, double side_px, const Stroke& stroke, bool cross);
/// The sign of a target.
void draw_pin(Canvas& canvas, const Point2& at_px, double size_px);

/// More gaps than this are counted, not numbered on the map.
inline constexpr std::size_t kNumberedGaps = 9;

}  // namespace seeker::image
