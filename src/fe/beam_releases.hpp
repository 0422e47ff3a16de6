// Released ends of beams: no moment about some of the axes of the section.
#pragma once

#include "fe/beam.hpp"

namespace gannet {

/// BeamReleases ends of elements about axes of their sections at a node: every element that meets
/// there but the last, the only one where a line ends. axes: bits 0, 1, 2 for x, y, z. The moments
/// about them vanish, and with a released end the other one alone says how the element is turned
/// about its chord. Returns whether the node is one of the block.
bool release(BeamBlock& block, Index node, unsigned axes);

/// What the frame of an element follows of the triads of its nodes: both, or the one whose end is
/// not released.
double share_of_first(unsigned released);

/// What of the strain of an element with released ends its section feels.
struct BeamReleases {
  bool first[3], second[3];
  double share[3];  ///< turn of the released end over that of the other, see release()

  /// bits: BeamBlock::released of the element, l0: its length [m].
  BeamReleases(const BeamLaw& law, double l0, unsigned bits);

  void reduce(BeamStrain& q) const;

  /// The transpose: moments of the reduced strain on the ends.
  void expand(BeamStress& f) const;
};

}  // namespace gannet
