#include "fe/beam_releases.hpp"

#include <vector>

namespace gannet {

namespace {

/// Turns of released ends in one plane over those of the other end: the ones without moment.
double follows(const BeamLaw& law, double I, double A_s, double l0) {
  const BendingStiffness k = bending_of(law, I, A_s, l0);
  return -k.k2 / k.k4;
}

}  // namespace

bool release(BeamBlock& block, Index node, unsigned axes) {
  std::vector<std::size_t> ends;
  for (std::size_t k = 0; k < block.ends.size(); ++k) {
    if (block.ends[k] == node) ends.push_back(k);
  }
  if (ends.empty()) return false;
  if (ends.size() > 1) ends.pop_back();
  block.released.resize(block.l0.size(), 0);
  for (const std::size_t k : ends) {
    std::uint8_t& bits = block.released[k / 2];
    bits = static_cast<std::uint8_t>(bits | axes << (k % 2 == 0 ? 0U : 3U));
  }
  return true;
}

double share_of_first(unsigned released) {
  const bool first = (released & 7U) != 0;
  const bool second = (released >> 3U) != 0;
  return first == second ? 0.5 : (first ? 0.0 : 1.0);
}

BeamReleases::BeamReleases(const BeamLaw& law, double l0, unsigned bits) {
  for (unsigned i = 0; i < 3; ++i) {
    first[i] = (bits >> i & 1U) != 0;
    second[i] = (bits >> (3 + i) & 1U) != 0;
  }
  share[0] = 1;  // no twist
  share[1] = follows(law, law.section.I_y, law.section.A_z, l0);
  share[2] = follows(law, law.section.I_z, law.section.A_y, l0);
}

void BeamReleases::reduce(BeamStrain& q) const {
  for (int i = 0; i < 3; ++i) {
    if (first[i] && second[i]) q.theta_1[i] = q.theta_2[i] = 0;
    if (first[i] && !second[i]) q.theta_1[i] = share[i] * q.theta_2[i];
    if (second[i] && !first[i]) q.theta_2[i] = share[i] * q.theta_1[i];
  }
}

void BeamReleases::expand(BeamStress& f) const {
  for (int i = 0; i < 3; ++i) {
    if (first[i] && !second[i]) f.m_2[i] += share[i] * f.m_1[i];
    if (second[i] && !first[i]) f.m_1[i] += share[i] * f.m_2[i];
    if (first[i]) f.m_1[i] = 0;
    if (second[i]) f.m_2[i] = 0;
  }
}

}  // namespace gannet
