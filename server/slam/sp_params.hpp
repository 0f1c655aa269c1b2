/// \file
/// Parameters of the SPmap (spec S1.6-S1.9). Gates are values of chi-square, spec S0.4.
#pragma once

#include <cstdint>

namespace seeker::slam {

/// How observations are paired with segments and used.
enum class SpMode : std::uint8_t {
  kJoint,  ///< joint compatibility, one joint update
  kPaper,  ///< nearest neighbour, one update a pair (spec S1.6, S1.7)
};

struct SpAssociationParams {
  /// Of a pair's (y, theta): 2 dof, 99.9 %. Wide, since what a gate refuses is not refused by chance: those pairs are
  /// the ones that know how far off the robot is (within 95 % its NEES is 3.21 and not 3.01: R2, odometry, seeds
  /// 1-200).
  double gate = 13.816;
  double nearest_gate = 5.991;  ///< the same in paper mode: 95 % (spec S1.6)
  double end_gate = 6.635;      ///< of an endpoint: 1 dof, 99 %
  double near_gate = 36.0;      ///< no new segment where an observation is this near to an old one
  double joint_sigmas = 3.090;  ///< joint gate: quantile of chi-square at this many normal sigmas (99.9 %)
  /// ... where most walls miss their gates: then it is the robot that is off, for all of them alike, and those within
  /// the near gate are paired if most of them agree (99.99 %).
  double surprise_sigmas = 3.719;
  double max_angle_rad = 0.5235987756;  ///< pairs differ by less (30 degrees, spec S1.5)
  double virtual_gap_m = 0.5;           ///< an observation beyond a virtual end may be this far off
  double real_gap_m = 0.15;             ///< beyond a real one, plus real_gap_sigmas
  double real_gap_sigmas = 3.0;
  double apart_penalty = 4.0;  ///< added to D2 of a pair that does not overlap, when hypotheses are compared
  int max_nodes = 2000;        ///< of the search for the largest compatible set
};

struct SpFeatureParams {
  int new_points = 12;            ///< an observation of so many points becomes a segment at once (spec S1.8)
  int new_scans = 2;              ///< one of fewer points when it was seen in so many consecutive scans
  double tentative_m = 0.15;      ///< it is the same one as in the last scan when it is not farther off
  double tentative_rad = 0.1745;  ///< and turned by less (10 degrees)
  int real_scans = 2;             ///< a virtual end becomes real when seen so in so many consecutive sightings
  int demote_scans = 3;           ///< a real end that is overrun so often in a row becomes virtual
  double min_length_m = 0.05;     ///< a segment whose ends come nearer than this is none: it is forgotten
  double end_slack_m = 0.15;      ///< a seen end this near (plus 3 sigma) is the end of the segment
  double merge_gate = 5.991;      ///< of two segments being one: 2 dof (spec S1.9)
  double merge_angle_rad = 0.1745;
  double merge_gap_m = 0.3;
  double merge_offset_m = 0.15;  ///< nor are two segments one whose lines are farther apart, however uncertain
  /// What lies beside a segment, another one or an observation, is part of it only when the offset between their lines
  /// is known this well: the side of a bed may lie a centimetre off the wall of the next room. 0: however badly, since
  /// real walls are not straight to a centimetre.
  double merge_sigma_m = 0.0;
  double doorway_m = 0.1;  ///< two real ends facing each other over more than this are a doorway
};

struct SpExistenceParams {
  int misses = 8;              ///< a segment that was looked through in so many scans in a row is gone
  int young_hits = 5;          ///< one that was seen less often
  int young_misses = 2;        ///< is gone after so many
  double margin_m = 0.25;      ///< a beam must pass the segment by this much (plus 3 sigma) to deny it
  double grazing_rad = 0.175;  ///< beams at a smaller angle to the segment say nothing
  double end_margin_m = 0.1;   ///< nor do those this near to its ends
  int beams = 16;              ///< looked at per segment, at most
  double denied = 0.6;         ///< share of them that must deny it
  int min_beams = 3;
};

struct SpMapParams {
  SpMode mode = SpMode::kJoint;
  SpAssociationParams association;
  SpFeatureParams features;
  SpExistenceParams existence;
  double relinearise_m = 0.01;  ///< the joint update is linearised once more when the robot moved by this
  double relinearise_rad = 0.003;
  double sigma_floor_m = 1e-4;  ///< no observation is believed to be better
  double sigma_floor_rad = 1e-4;
  /// An end is used again when its bearing has moved by so many beams. Where between two beams a wall ends stays the
  /// same while the same two see it, so that such sightings err alike. The golden ratio has the beams meet the end in
  /// ever other places; a whole number would have them meet it in the same one.
  double end_beams = 1.618;
  /// Random walk of a segment per update: keeps the covariance positive definite however long the robot looks.
  double drift_sigma_m = 1e-5;
  double drift_sigma_rad = 1e-5;
  double robot_sigma_max_m = 100.0;  ///< beyond it the robot's place is unknown: it is decorrelated from the map
  double robot_sigma_max_rad = 3.0;
  /// A direction in which the observed segments hold the robot worse than this is degenerate (a corridor).
  double degenerate_sigma_m = 0.5;
};

}  // namespace seeker::slam
