#include "fe/beam.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fe/beam_mass.hpp"
#include "fe/beam_releases.hpp"
#include "fe/beam_turns.hpp"
#include "fe/element_blocks.hpp"

namespace gannet {

namespace {

Vec3 at(std::span<const Line> x, Index node) { return xyz(x[static_cast<std::size_t>(node)]); }

Quaternion quaternion_of(const Line& line) { return {line.x, line.y, line.z, line.w}; }

/// Rotation vector of a unit quaternion with w >= 0.
Vec3 rotation_vector(const Quaternion& q) {
  const double s = q.vec().norm();
  // 2 atan2(s, w)/s; for small s by its series, the next term of which is below rounding.
  const double factor = s > 1e-5 ? 2 * std::atan2(s, q.w()) / s : 2 + s * s / 3;
  return factor * q.vec();
}

/// T^T m, T the map from the spin of a rotation to the rate of its vector:
///   T = 1 - theta/2 x + c theta x theta x,  c = (1 - (|theta|/2) cot(|theta|/2))/|theta|^2
Vec3 conjugate_to_spin(const Vec3& theta, const Vec3& m) {
  const double t = theta.norm();
  const double c = t > 1e-2 ? (1 - 0.5 * t / std::tan(0.5 * t)) / (t * t) : 1.0 / 12 + t * t / 720;
  const Vec3 cross = theta.cross(m);
  return m + 0.5 * cross + c * theta.cross(cross);
}

/// Axes of the section: x along r, z near `up`.
Quaternion section_frame(const Vec3& r, const Vec3& up) {
  Vec3 z = up;
  const Vec3 x = r.normalized();
  if (up.isZero(0)) z = std::abs(x.z()) > 0.999 ? Vec3::UnitX() : Vec3::UnitZ();
  const Vec3 y = z.cross(x);
  if (!(y.norm() > 1e-6 * z.norm())) return {0, 0, 0, 0};
  Mat3 axes;
  axes << x, y.normalized(), x.cross(y).normalized();
  return Quaternion(axes);
}

/// Where an element is and what its ends have turned against it.
struct BeamPose {
  Quaternion frame;
  Vec3 e1 = Vec3::Zero();
  double l = 0;
  Vec3 theta_1 = Vec3::Zero();
  Vec3 theta_2 = Vec3::Zero();
};

/// t_1, t_2: triads of the nodes; r: chord [m]; share: of t_1 in the frame, 0, 1/2 or 1.
BeamPose pose_of(const Quaternion& t_1, Quaternion t_2, const Vec3& r, double share) {
  BeamPose pose;
  pose.l = r.norm();
  pose.e1 = pose.l > 0 ? Vec3(r / pose.l) : Vec3(t_1 * Vec3::UnitX());
  if (t_1.dot(t_2) < 0) t_2.coeffs() *= -1;
  Quaternion mean;
  mean.coeffs() = share == 0.5 ? Quaternion::Coefficients(t_1.coeffs() + t_2.coeffs())
                               : (share == 0 ? t_2 : t_1).coeffs();
  mean.normalize();
  // The smallest rotation that takes the mean axis to the chord.
  const Vec3 axis = mean * Vec3::UnitX();
  const Vec3 v = axis.cross(pose.e1);
  const Quaternion turn = Quaternion(1 + axis.dot(pose.e1), v.x(), v.y(), v.z()).normalized();
  pose.frame = turn * mean;
  const auto against = [&](const Quaternion& t) {
    Quaternion d = pose.frame.conjugate() * t;
    if (d.w() < 0) d.coeffs() *= -1;
    return rotation_vector(d);
  };
  pose.theta_1 = against(t_1);
  pose.theta_2 = against(t_2);
  return pose;
}

/// Keeps the section forces of element e at its middle.
void show_forces(BeamBlock& block, Index e, const BeamForces& f, double inverse_l) {
  const Vec3 sum = f.M_1 + f.M_2;
  const Vec3 middle = 0.5 * (f.M_2 - f.M_1);
  double* out = &block.forces[6 * static_cast<std::size_t>(e)];
  out[0] = f.N;
  out[1] = -sum.z() * inverse_l;  // force across that balances the moments
  out[2] = sum.y() * inverse_l;
  for (Eigen::Index i = 0; i < 3; ++i) out[3 + i] = middle[i];
}

BeamStress elastic_stress(const BeamLaw& law, double l0, const BeamStrain& q) {
  const BeamSection& s = law.section;
  const BendingStiffness about_y = bending_of(law, s.I_y, s.A_z, l0);
  const BendingStiffness about_z = bending_of(law, s.I_z, s.A_y, l0);
  const double T = law.G * s.J / l0 * (q.theta_2.x() - q.theta_1.x());
  const Vec3 k4(0, about_y.k4, about_z.k4);
  const Vec3 k2(0, about_y.k2, about_z.k2);
  return {law.E * s.A * q.u / l0,
          k4.cwiseProduct(q.theta_1) + k2.cwiseProduct(q.theta_2) - T * Vec3::UnitX(),
          k2.cwiseProduct(q.theta_1) + k4.cwiseProduct(q.theta_2) + T * Vec3::UnitX()};
}

double energy_of(const BeamStress& f, const BeamStrain& q) {
  return 0.5 * (f.N * q.u + f.m_1.dot(q.theta_1) + f.m_2.dot(q.theta_2));
}

/// Moments against spins. The frame turns about its x axis with its nodes, by their shares.
BeamForces against_spins(const BeamStress& f, const Vec3& theta_1, const Vec3& theta_2,
                         double share) {
  BeamForces out{f.N, conjugate_to_spin(theta_1, f.m_1), conjugate_to_spin(theta_2, f.m_2)};
  const double excess = out.M_1.x() + out.M_2.x();
  out.M_1.x() -= share * excess;
  out.M_2.x() -= (1 - share) * excess;
  return out;
}

/// Strain and forces of a level as 14 numbers in a row.
void keep(const BeamStrain& q, const BeamStress& f, double* to) {
  *to++ = q.u;
  for (const Vec3* v : {&q.theta_1, &q.theta_2}) {
    for (int i = 0; i < 3; ++i) *to++ = (*v)[i];
  }
  *to++ = f.N;
  for (const Vec3* v : {&f.m_1, &f.m_2}) {
    for (int i = 0; i < 3; ++i) *to++ = (*v)[i];
  }
}

void load(const double* from, BeamStrain& q, BeamStress& f) {
  q.u = *from++;
  for (Vec3* v : {&q.theta_1, &q.theta_2}) {
    for (int i = 0; i < 3; ++i) (*v)[i] = *from++;
  }
  f.N = *from++;
  for (Vec3* v : {&f.m_1, &f.m_2}) {
    for (int i = 0; i < 3; ++i) (*v)[i] = *from++;
  }
}

YieldingBeam yielding(const BeamLaw& law, double l0) {
  const BeamSection& s = law.section;
  return {law.yield,
          s,
          law.G,
          l0,
          shear_ratio(law, s.I_y, s.A_z, l0),
          shear_ratio(law, s.I_z, s.A_y, l0)};
}

/// What of element k's fibres and of its elastic part leaves when it breaks in this step.
double energy_of_break(const YieldingBeam& beam, std::span<const double> states,
                       const BeamStrain& from, const BeamStrain& to) {
  const BeamStress f = elastic_part(beam, from);
  return energy_of(f, from) + work_of(f, {}, from, to) + held_by_fibres(beam, states, from, to);
}

/// Stress of element k at a strain, fibres taken on; its energies are added to the sums.
BeamStress section_stress(BeamBlock& block, std::size_t k, const BeamStrain& q, double dt,
                          BeamSums& sums) {
  const BeamLaw& law = block.law;
  const double l0 = block.l0[k];
  if (!law.yield.yields()) {
    const BeamStress f = elastic_stress(law, l0, q);
    sums.energy += energy_of(f, q);
    return f;
  }
  const YieldingBeam beam = yielding(law, l0);
  const std::size_t n = fibre_values(law.section, law.yield);
  const std::span<double> states(block.fibres.data() + n * k, n);
  FibreStep step;
  BeamStress f_old;
  load(&block.last[14 * k], step.from, f_old);
  step.inverse_dt = dt > 0 ? 1 / dt : 0;
  std::vector<double> before;
  if (law.yield.fails()) before.assign(states.begin(), states.end());
  BeamStress f = yielding_stress(beam, q, states, step);
  if (step.broken) {
    block.gone[k] = 1;
    f = {};
    step.plastic = 0;
    step.eroded = energy_of_break(beam, before, step.from, q);
  }
  sums.energy += work_of(f_old, f, step.from, q) - step.eroded;
  sums.plastic += step.plastic;
  sums.eroded += step.eroded;
  keep(q, f, &block.last[14 * k]);
  return f;
}

/// Adds the damping of element k, beta K (q(n) - q(n-1))/dt; of one that has left, nothing.
void add_damping(BeamBlock& block, std::size_t k, const BeamStrain& q, double dt, BeamStress& f,
                 BeamSums& sums) {
  double* kept = &block.damping_last[14 * k];
  BeamStrain q_old;
  BeamStress d_old;
  load(kept, q_old, d_old);
  BeamStress d;
  if (dt > 0) {
    const double rate = block.has_left(k) ? 0 : block.damping_time[k] / dt;
    d = elastic_stress(block.law, block.l0[k],
                       {rate * (q.u - q_old.u), rate * (q.theta_1 - q_old.theta_1),
                        rate * (q.theta_2 - q_old.theta_2)});
    sums.damping += work_of(d_old, d, q_old, q);
  }
  keep(q, d, kept);
  f.N += d.N;
  f.m_1 += d.m_1;
  f.m_2 += d.m_2;
}

/// The bound that element k votes with [1/s^2].
double vote_of(const BeamBlock& block, std::size_t k, double l, double N) {
  double omega2 = omega2_of(block.law, block.l0[k], l, N);
  if (!block.damping_time.empty()) {
    const double zeta = 0.5 * block.damping_time[k] * std::sqrt(omega2);
    const double factor = std::sqrt(1 + zeta * zeta) + zeta;
    omega2 *= factor * factor;
  }
  return block.inverse_mass.empty() ? omega2 : omega2 * block.inverse_mass[k];
}

/// Forces of element k at its pose.
BeamForces element_forces(BeamBlock& block, std::size_t k, const BeamPose& pose, double dt,
                          BeamSums& sums) {
  const unsigned bits = block.released.empty() ? 0 : block.released[k];
  BeamStrain q{pose.l - block.l0[k], pose.theta_1, pose.theta_2};
  BeamStress f;
  if (bits == 0) {
    f = section_stress(block, k, q, dt, sums);
    if (!block.damping_time.empty()) add_damping(block, k, q, dt, f, sums);
  } else {
    const BeamReleases releases(block.law, block.l0[k], bits);
    releases.reduce(q);
    f = section_stress(block, k, q, dt, sums);
    if (!block.damping_time.empty()) add_damping(block, k, q, dt, f, sums);
    releases.expand(f);
  }
  return against_spins(f, pose.theta_1, pose.theta_2, share_of_first(bits));
}

/// Elements [begin, end): forces and moments added.
BeamSums pass_over(BeamBlock& block, Nodes& nodes, double dt, Index begin, Index end) {
  BeamSums sums;
  for (Index e = begin; e < end; ++e) {
    const auto k = static_cast<std::size_t>(e);
    if (block.has_left(k)) {
      show_forces(block, e, {}, 0);
      continue;
    }
    const Index a = block.ends[2 * k];
    const Index b = block.ends[2 * k + 1];
    const auto triad = [&](Index i) -> Quaternion {
      return quaternion_of(block.turned[static_cast<std::size_t>(i - block.nodes.begin)]) *
             block.frame[k];
    };
    const double share = block.released.empty() ? 0.5 : share_of_first(block.released[k]);
    const BeamPose pose = pose_of(triad(a), triad(b), at(nodes.x, b) - at(nodes.x, a), share);
    const BeamForces f = element_forces(block, k, pose, dt, sums);
    const Vec3 M_1 = pose.frame * f.M_1;
    const Vec3 M_2 = pose.frame * f.M_2;
    const double inverse_l = pose.l > 0 ? 1 / pose.l : 0.0;
    const Vec3 pull = f.N * pose.e1 - (M_1 + M_2).cross(pose.e1) * inverse_l;
    add_xyz(nodes.f[static_cast<std::size_t>(a)], pull);
    add_xyz(nodes.f[static_cast<std::size_t>(b)], -pull);
    add_xyz(nodes.torque[static_cast<std::size_t>(a)], -M_1);
    add_xyz(nodes.torque[static_cast<std::size_t>(b)], -M_2);
    show_forces(block, e, f, inverse_l);
    const double omega2 = vote_of(block, k, pose.l, f.N);
    if (omega2 <= sums.omega2) continue;
    sums.omega2 = omega2;
    sums.element = e;
  }
  return sums;
}

}  // namespace

BeamForces beam_forces(const BeamLaw& law, double l0, double u, const Vec3& theta_1,
                       const Vec3& theta_2, double& energy) {
  const BeamStrain q{u, theta_1, theta_2};
  const BeamStress f = elastic_stress(law, l0, q);
  energy = energy_of(f, q);
  return against_spins(f, theta_1, theta_2, 0.5);
}

BeamBlock make_beam_block(std::span<const Index> ends, Range range, std::span<const Line> x,
                          const BeamLaw& law, const Vec3& up) {
  BeamBlock block;
  block.law = law;
  block.nodes = range;
  block.ends.assign(ends.begin(), ends.end());
  const std::size_t n = ends.size() / 2;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 r = at(x, ends[2 * k + 1]) - at(x, ends[2 * k]);
    const std::string who = "element " + std::to_string(k + 1);
    if (!(r.norm() > 0)) throw std::invalid_argument(who + " has no length");
    block.l0.push_back(r.norm());
    block.frame.push_back(section_frame(r, up));
    if (block.frame.back().coeffs().isZero(0)) {
      throw std::invalid_argument(who + " lies along 'up', which says nothing about its section");
    }
  }
  block.turned.assign(static_cast<std::size_t>(range.size()), {1, 0, 0, 0});
  block.energy.assign(1, 0);
  block.forces.assign(6 * n, 0);
  if (law.yield.yields()) {
    block.fibres.assign(n * fibre_values(law.section, law.yield), 0);
    block.last.assign(14 * n, 0);
    if (law.yield.fails()) block.gone.assign(n, 0);
  }
  if (law.damping.given()) block.damping_last.assign(14 * n, 0);
  block.colouring = colour_chunks(block.ends, 2, beam_chunk);
  block.sums.resize(static_cast<std::size_t>(block.colouring.n_chunks));
  return block;
}

ElementWork beam_pass(BeamBlock& block, Nodes& nodes, double dt_old) {
  turn_nodes(block, nodes, dt_old);
  const Index n = block.n_elements();
  for_chunks_by_colour(block.colouring, n, [&](Index chunk, Index begin, Index end) {
    block.sums[static_cast<std::size_t>(chunk)] =
        pass_over(block, nodes, dt_old, lanes * begin, std::min(n, lanes * end));
  });
  double energy = 0;
  ElementWork work;
  block.omega2 = 0;
  block.limiting = -1;
  for (const BeamSums& s : block.sums) {
    energy += s.energy;
    work.plastic += s.plastic;
    work.damping += s.damping;
    work.eroded += s.eroded;
    if (s.omega2 <= block.omega2) continue;
    block.omega2 = s.omega2;
    block.limiting = s.element;
  }
  const bool yields = block.law.yield.yields();
  work.internal = yields ? energy : energy - block.energy[0];
  block.energy[0] = yields ? block.energy[0] + energy : energy;
  return work;
}

double stable_step(const BeamBlock& block) {
  // Where all have left it is that of an element as it was.
  const double omega2 =
      block.omega2 > 0 ? block.omega2 : omega2_of(block.law, block.l0[0], block.l0[0], 0);
  return block.law.dt_factor * 2 / std::sqrt(omega2);
}

}  // namespace gannet
