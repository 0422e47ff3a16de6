#include "sph/reference_pass.hpp"

#include <Eigen/LU>

#include "base/math.hpp"
#include "kernel/smoothing_kernel.hpp"

namespace gannet {

namespace {

SmoothingKernel kernel_of(const PairParameters& k) { return {k.kernel, k.dimension, k.h}; }

/// Pi_ij = 2/(rho_i + rho_j) (-alpha c0 mu + beta mu^2) for closing pairs, 0 for others.
double viscosity(const PairParameters& k, const Vec3& r_ij, const Vec3& v_ij, double rho_mean) {
  const double v_r = v_ij.dot(r_ij);
  if (v_r >= 0) return 0;
  const double mu = k.h * v_r / (r_ij.squaredNorm() + 0.01 * k.h * k.h);
  return (-k.alpha * k.c0 * mu + k.beta * mu * mu) / rho_mean;
}

/// S = sum F r (x) r of a target, with 1 for the missing direction of a plane.
Mat3 moment_of(const ParticleView& view, Index i, const PairParameters& k) {
  Mat3 S = Mat3::Zero();
  for (Index j = 0; j < view.n_sources; ++j) {
    const Vec3 r_ij = xyz(view.x[i]) - xyz(view.x[j]);
    S += kernel_of(k).F(r_ij.norm()) * r_ij * r_ij.transpose();
  }
  if (k.dimension == 2) S(2, 2) = -k.rho0 / k.m;
  return S;
}

bool usable(const Mat3& S, const PairParameters& k) {
  return (-k.m / k.rho0 * S).determinant() >= 0.75;
}

double closeness(const PairParameters& k, double W) {
  const double f = W / kernel_of(k).W(k.dx);
  return f * f * f * f;
}

}  // namespace

void reference_rates(const ParticleView& view, Index n_targets, const PairParameters& k,
                     const RatesOut& out) {
  const double V = k.m / k.rho0;
  for (Index i = 0; i < n_targets; ++i) {
    double rate = 0;
    double diffusion = 0;
    double div_r = 0;
    double mW = 0;
    double VW = 0;
    Vec3 X = Vec3::Zero();
    Vec3 concentration = Vec3::Zero();
    Mat3 G = Mat3::Zero();
    for (Index j = 0; j < view.n_sources; ++j) {
      const Vec3 r_ij = xyz(view.x[i]) - xyz(view.x[j]);
      const Vec3 v_ij = xyz(view.v[i]) - xyz(view.v[j]);
      const double F = kernel_of(k).F(r_ij.norm());
      const double W = kernel_of(k).W(r_ij.norm());
      rate += k.m * v_ij.dot(F * r_ij);
      X -= k.epsilon * k.m / (0.5 * (view.rho[i] + view.rho[j])) * W * v_ij;
      if (view.s != nullptr)
        diffusion += 2 * k.delta * k.h * k.c0 * V * (view.s[i] - view.s[j]) * F;
      div_r -= V * F * r_ij.squaredNorm();
      if (k.dx > 0) concentration += V * (1 + 0.2 * closeness(k, W)) * F * r_ij;
      mW += k.m * W;
      VW += k.m / view.rho[j] * W;
      G += F * v_ij * r_ij.transpose();
    }
    const Mat3 S = moment_of(view, i, k);
    const double corrected = usable(S, k) ? -view.rho[i] * (G * S.inverse()).trace() : rate;
    out.drho_dt[i] = rate;
    if (out.drho_diffusion != nullptr) out.drho_dt[i] += out.drho_diffusion[i] = diffusion;
    if (out.drho_correction != nullptr) {
      out.drho_dt[i] += out.drho_correction[i] = corrected - rate;
    }
    if (out.X != nullptr) out.X[i] = {X.x(), X.y(), X.z(), 0};
    if (out.concentration != nullptr) {
      out.concentration[i] = {concentration.x(), concentration.y(), concentration.z(), div_r};
    }
    if (out.sum_mW != nullptr) out.sum_mW[i] = mW;
    if (out.sum_VW != nullptr) out.sum_VW[i] = VW;
  }
}

void reference_force(const ParticleView& view, Index n_targets, const PairParameters& k,
                     const ForceOut& out) {
  const double m2 = k.m * k.m;
  auto p_rho2 = [&](Index i) { return view.p[i] / (view.rho[i] * view.rho[i]); };
  auto tension = [&](Index i) { return std::max(-p_rho2(i), 0.0); };
  for (Index i = 0; i < n_targets; ++i) {
    Vec3 f = Vec3::Zero();
    Vec3 f_viscous = Vec3::Zero();
    Vec3 f_laminar = Vec3::Zero();
    Vec3 f_tensile = Vec3::Zero();
    Vec3 g = Vec3::Zero();
    for (Index j = 0; j < view.n_sources; ++j) {
      const Vec3 r_ij = xyz(view.x[i]) - xyz(view.x[j]);
      const Vec3 v_ij = xyz(view.v[i]) - xyz(view.v[j]);
      const double r2 = r_ij.squaredNorm();
      const Vec3 grad_W = kernel_of(k).F(r_ij.norm()) * r_ij;
      const double W = kernel_of(k).W(r_ij.norm());
      f -= m2 * (p_rho2(i) + p_rho2(j)) * grad_W;
      const double rho_mean = 0.5 * (view.rho[i] + view.rho[j]);
      f_viscous -= m2 * viscosity(k, r_ij, v_ij, rho_mean) * grad_W;
      const double c = m2 * 2 * k.mu / (view.rho[i] * view.rho[j]) / (r2 + 0.01 * k.h * k.h);
      f_laminar += k.central ? Vec3(c * (k.dimension + 2) * v_ij.dot(r_ij) * grad_W)
                             : Vec3(c * r_ij.dot(grad_W) * v_ij);
      if (k.dx > 0) {
        f_tensile -= k.tensile * m2 * (tension(i) + tension(j)) * closeness(k, W) * grad_W;
      }
      g += (view.p[j] - view.p[i]) * grad_W;
    }
    const Mat3 S = moment_of(view, i, k);
    const Vec3 corrected = usable(S, k) ? Vec3(k.m / view.rho[i] * (S.inverse() * g)) : f;
    add_xyz(out.f[i], f);
    const auto put = [&](Line* lines, const Vec3& part) {
      if (lines == nullptr) return;
      add_xyz(out.f[i], part);
      lines[i] = {part.x(), part.y(), part.z(), 0};
    };
    put(out.f_viscous, f_viscous);
    put(out.f_laminar, f_laminar);
    put(out.f_tensile, f_tensile);
    put(out.f_correction, corrected - f);
  }
}

}  // namespace gannet
