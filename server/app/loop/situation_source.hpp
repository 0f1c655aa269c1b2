/// \file
/// SituationSource gathers what a mission may know at one moment from those who own it.
#pragma once

#include "server/app/loop/localiser.hpp"
#include "server/app/loop/neighbours.hpp"
#include "server/app/loop/sensing.hpp"
#include "server/app/loop/world_link.hpp"
#include "server/app/missions/behaviour.hpp"

namespace seeker::app {

/// Owns nothing. Lives on the loop's thread.
class SituationSource {
 public:
  /// The references must outlive it. `has_stereo` says whether features can be found in pictures of a stereo camera.
  SituationSource(const WorldLink& world, const Sensing& sensing, const Localiser& localiser,
                  const Neighbours& neighbours, bool has_stereo)
      : world_(world), sensing_(sensing), localiser_(localiser), neighbours_(neighbours), has_stereo_(has_stereo) {}

  /// Returns the situation; its pointers are valid until the next Sensing::read().
  [[nodiscard]] Situation situation() const;
  /// Returns the other robots as they are now, in frame `base`.
  [[nodiscard]] std::vector<nav::Mover> movers_base() const;

 private:
  const WorldLink& world_;
  const Sensing& sensing_;
  const Localiser& localiser_;
  const Neighbours& neighbours_;
  bool has_stereo_;
};

}  // namespace seeker::app
