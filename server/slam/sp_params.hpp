/// \file
/// Parameters of the SPmap (spec S1.6-S1.9). Gates are values of chi-square, spec S0.4.
#pragma once

#include <cstdint>

namespace seeker::slam {

/// How observations are associated with segments.
enum class SpAssociationMethod : std::uint8_t {
  kJoint,             ///< the largest set of pairs that are compatible with each other
  kNearestNeighbour,  ///< each observation with its nearest segment, as printed (spec S1.6)
};

/// How the pairs of a scan correct the map.
enum class SpUpdateMethod : std::uint8_t {
  kJoint,       ///< all pairs at once
  kSequential,  ///< pair by pair, the nearest first, centring after each, as printed (spec S1.7)
};

struct SpAssociationParams {
  SpAssociationMethod method = SpAssociationMethod::kJoint;
  /// Gate of a pair's (y, theta): 2 dof, 99.9 %. It is wide, since the pairs that a gate rejects are not random: they
  /// hold the information about a large error of the robot (with a gate of 95 % its NEES is 3.21 instead of 3.01: R2,
  /// odometry, seeds 1-200).
  double gate = 13.816;
  double nearest_gate = 5.991;  ///< the same for the nearest neighbour: 95 % (spec S1.6)
  double end_gate = 6.635;      ///< gate of an endpoint: 1 dof, 99 %
  /// No new segment is created where an observation is within this gate of an existing one.
  double near_gate = 36.0;
  double joint_sigmas = 3.090;  ///< joint gate: quantile of chi-square at this many normal sigmas (99.9 %)
  /// Joint gate where most walls miss their individual gates: then the pose of the robot is wrong for all of them
  /// alike, and those within the near gate are paired if most of them agree (99.99 %).
  double surprise_sigmas = 3.719;
  /// Largest angle between an observation and its segment (30 degrees, spec S1.5).
  double max_angle_rad = 0.5235987756;
  double virtual_gap_m = 0.5;  ///< largest gap between an observation and a virtual end before it
  double real_gap_m = 0.15;    ///< largest gap beyond a real end, in addition to real_gap_sigmas
  double real_gap_sigmas = 3.0;
  double apart_penalty = 4.0;  ///< added to D2 of a pair that does not overlap, when hypotheses are compared
  int max_nodes = 2000;        ///< limit of the search for the largest compatible set
};

struct SpFeatureParams {
  int new_points = 12;            ///< an observation with so many points becomes a segment immediately (spec S1.8)
  int new_scans = 2;              ///< an observation with fewer points becomes one after so many consecutive scans
  double tentative_m = 0.15;      ///< largest offset between observations of one new wall in consecutive scans
  double tentative_rad = 0.1745;  ///< largest angle between them (10 degrees)
  int real_scans = 2;             ///< number of consecutive observations as real after which a virtual end becomes real
  int demote_scans = 3;           ///< number of consecutive overruns after which a real end becomes virtual
  double min_length_m = 0.05;     ///< a segment whose ends come closer than this is removed
  double end_slack_m = 0.15;      ///< an observed end this close (plus 3 sigma) is the end of the segment
  double merge_gate = 5.991;      ///< gate for merging two segments: 2 dof (spec S1.9)
  double merge_angle_rad = 0.1745;
  double merge_gap_m = 0.3;
  /// Upper limit of the offset between the lines of merged segments, however uncertain they are.
  double merge_offset_m = 0.15;
  /// An observation or segment beside a segment is merged with it only when the offset between their lines is known
  /// with this standard deviation: the side of a bed may lie a centimetre off the wall of the next room. 0: without a
  /// limit, since real walls are not straight to a centimetre.
  double merge_sigma_m = 0.0;
  double doorway_m = 0.1;  ///< two real ends facing each other over more than this form a doorway
};

struct SpExistenceParams {
  int misses = 8;              ///< number of scans in a row through a segment after which it is removed
  int young_hits = 5;          ///< a segment with fewer hits than this
  int young_misses = 2;        ///< is removed after so many scans
  double margin_m = 0.25;      ///< distance (plus 3 sigma) by which a beam must pass the segment to deny it
  double grazing_rad = 0.175;  ///< beams at a smaller angle to the segment are not evaluated
  double end_margin_m = 0.1;   ///< nor are beams this close to its ends
  int beams = 16;              ///< number of evaluated beams per segment, at most
  double denied = 0.6;         ///< share of these beams that must deny it
  int min_beams = 3;
};

struct SpMapParams {
  SpAssociationParams association;
  SpUpdateMethod update = SpUpdateMethod::kJoint;
  SpFeatureParams features;
  SpExistenceParams existence;
  /// The joint update is linearised once more when the robot's correction exceeds this.
  double relinearise_m = 0.01;
  double relinearise_rad = 0.003;
  double sigma_floor_m = 1e-4;  ///< lower limit of the standard deviation of an observation
  double sigma_floor_rad = 1e-4;
  /// An end is used again when its bearing has moved by so many beams. The position of a wall's end between two beams
  /// stays the same while the same two beams observe it, so that such observations have correlated errors. By the
  /// golden ratio the beams meet the end at ever different positions; a whole number would have them meet it at the
  /// same one.
  double end_beams = 1.618;
  /// Random walk of a segment per update, which keeps the covariance positive definite however long the robot observes.
  double drift_sigma_m = 1e-5;
  double drift_sigma_rad = 1e-5;
  double robot_sigma_max_m = 100.0;  ///< beyond it the robot's position is unknown: it is decorrelated from the map
  double robot_sigma_max_rad = 3.0;
  /// A direction along which the observed segments constrain the robot worse than this is degenerate (a corridor).
  double degenerate_sigma_m = 0.5;
};

}  // namespace seeker::slam
