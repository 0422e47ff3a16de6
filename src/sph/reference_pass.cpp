#include "sph/reference_pass.hpp"

#include "base/math.hpp"
#include "kernel/cubic_spline.hpp"

namespace gannet {

namespace {

/// Pi_ij = 2/(rho_i + rho_j) (-alpha c0 mu + beta mu^2) for closing pairs, 0 for others.
double viscosity(const PairParameters& k, const Vec3& r_ij, const Vec3& v_ij, double rho_mean) {
  const double v_r = v_ij.dot(r_ij);
  if (v_r >= 0) return 0;
  const double mu = k.h * v_r / (r_ij.squaredNorm() + 0.01 * k.h * k.h);
  return (-k.alpha * k.c0 * mu + k.beta * mu * mu) / rho_mean;
}

}  // namespace

void reference_rates(const ParticleView& view, Index n_targets, const PairParameters& k,
                     const RatesOut& out) {
  for (Index i = 0; i < n_targets; ++i) {
    double drho_dt = 0;
    Vec3 X = Vec3::Zero();
    for (Index j = 0; j < view.n_sources; ++j) {
      const Vec3 r_ij = xyz(view.x[i]) - xyz(view.x[j]);
      const Vec3 v_ij = xyz(view.v[i]) - xyz(view.v[j]);
      const double r = r_ij.norm();
      const Vec3 grad_W = cubic_spline::F(k.dimension, r, k.h) * r_ij;
      drho_dt += k.m * v_ij.dot(grad_W);
      const double rho_mean = 0.5 * (view.rho[i] + view.rho[j]);
      X -= k.epsilon * k.m / rho_mean * cubic_spline::W(k.dimension, r, k.h) * v_ij;
    }
    out.drho_dt[i] = drho_dt;
    if (out.X != nullptr) out.X[i] = {X.x(), X.y(), X.z(), 0};
  }
}

void reference_force(const ParticleView& view, Index n_targets, const PairParameters& k,
                     const ForceOut& out) {
  auto p_rho2 = [&](Index i) { return view.p[i] / (view.rho[i] * view.rho[i]); };
  for (Index i = 0; i < n_targets; ++i) {
    Vec3 f = Vec3::Zero();
    Vec3 f_viscous = Vec3::Zero();
    for (Index j = 0; j < view.n_sources; ++j) {
      const Vec3 r_ij = xyz(view.x[i]) - xyz(view.x[j]);
      const Vec3 v_ij = xyz(view.v[i]) - xyz(view.v[j]);
      const Vec3 grad_W = cubic_spline::F(k.dimension, r_ij.norm(), k.h) * r_ij;
      f -= k.m * k.m * (p_rho2(i) + p_rho2(j)) * grad_W;
      const double rho_mean = 0.5 * (view.rho[i] + view.rho[j]);
      f_viscous -= k.m * k.m * viscosity(k, r_ij, v_ij, rho_mean) * grad_W;
    }
    add_xyz(out.f[i], f);
    if (out.f_viscous == nullptr) continue;
    add_xyz(out.f[i], f_viscous);
    out.f_viscous[i] = {f_viscous.x(), f_viscous.y(), f_viscous.z(), 0};
  }
}

}  // namespace gannet
