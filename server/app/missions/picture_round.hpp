/// \file
/// Pictures of one camera in several directions from where the robot stands: it turns on the spot and asks for one at
/// each heading. A camera that sees all around needs a single one.
#pragma once

#include <optional>
#include <vector>

#include "common/core/map_move.hpp"
#include "server/app/missions/behaviour.hpp"
#include "server/app/missions/rotate_and_look.hpp"
#include "server/search/detection_tracker.hpp"
#include "server/vision/recogniser_params.hpp"

namespace seeker::app {

struct RoundParams {
  RotateAndLookParams look;
  double overlap_rad = deg_to_rad(18.0);  ///< of neighbouring pictures: as wide as what must not be cut by both
  double picture_timeout_s = 5.0;         ///< a picture that does not come counts as a failed look
};

class PictureRound {
 public:
  explicit PictureRound(const RoundParams& params)
      : sweep_(params.look), picture_timeout_s_(params.picture_timeout_s) {}

  /// Begins at the heading that the robot has.
  void start(const Situation& situation, int headings);
  /// From start() to finish().
  [[nodiscard]] bool started() const { return started_; }
  /// True until there is a picture of every heading, or it was left out.
  [[nodiscard]] bool active() const { return started_ && sweep_.active(); }
  [[nodiscard]] int index() const { return sweep_.index(); }
  [[nodiscard]] int headings() const { return sweep_.headings(); }
  /// Sets the decision's command, wants_image and events; must be active.
  void step(const Situation& situation, Decision& decision);
  /// The answer to wants_image.
  void take(const Recognition& recognition);
  void map_moved(const MapMove& move);
  void resumed();
  /// What was seen, and the end of the round.
  [[nodiscard]] std::vector<Recognition> finish();

 private:
  RotateAndLook sweep_;
  double picture_timeout_s_;
  bool started_ = false;
  std::optional<RobotTime> asked_at_;  ///< for the picture of this heading
  std::vector<Recognition> seen_;
};

/// How many pictures show all around one place. `view` is of photographs.
[[nodiscard]] int pictures_around(const vision::ViewParams& view, const RoundParams& params);

/// The pictures as the search has them. They point into `round`.
[[nodiscard]] std::vector<search::Look> to_looks(const std::vector<Recognition>& round);

}  // namespace seeker::app
