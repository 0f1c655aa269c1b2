/// \file
/// What a mission may know at one moment, gathered from those who own it.
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
  /// The references outlive it. `has_stereo`: there is a stereo camera whose pictures can be looked at.
  SituationSource(const WorldLink& world, const Sensing& sensing, const Localiser& localiser,
                  const Neighbours& neighbours, bool has_stereo)
      : world_(world), sensing_(sensing), localiser_(localiser), neighbours_(neighbours), has_stereo_(has_stereo) {}

  /// Its pointers are valid until the next reading.
  [[nodiscard]] Situation situation() const;
  /// Other robots as they are now, frame `base`.
  [[nodiscard]] std::vector<nav::Mover> movers_base() const;

 private:
  const WorldLink& world_;
  const Sensing& sensing_;
  const Localiser& localiser_;
  const Neighbours& neighbours_;
  bool has_stereo_;
};

}  // namespace seeker::app
