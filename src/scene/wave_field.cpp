#include "scene/wave_field.hpp"

#include <cmath>

namespace gannet {

namespace {

/// Functions of depth of one wave at K = k (Z + d), written so that nothing overflows in deep
/// water.
struct Profile {
  double c = 0;   ///< cosh K/S
  double s = 0;   ///< sinh K/S
  double c2 = 0;  ///< cosh 2K/S^2
  double s2 = 0;  ///< sinh 2K/S^2
  double S2 = 0;  ///< 1/S^2
  double tanh_kd = 0;
};

Profile profile_at(const WaveField& field, const WaveComponent& wave, double Z) {
  const double kd = wave.k * field.depth;
  const double K = wave.k * (Z + field.depth);
  const double q = 1 - std::exp(-2 * kd);
  const double e = std::exp(K - kd) / q;
  Profile p;
  p.c = e * (1 + std::exp(-2 * K));
  p.s = e * (1 - std::exp(-2 * K));
  p.c2 = 2 * e * e * (1 + std::exp(-4 * K));
  p.s2 = 2 * e * e * (1 - std::exp(-4 * K));
  p.S2 = 4 * std::exp(-2 * kd) / (q * q);
  p.tanh_kd = std::tanh(kd);
  return p;
}

/// Way of one wave and its rates.
struct Orbit {
  double theta = 0;
  double rate = 0;   ///< d theta/dt [rad/s]
  double drift = 0;  ///< U_s [m/s]
  double x1 = 0;     ///< xi = x1 sin theta + x2 sin 2 theta + drift t [m]
  double x2 = 0;
  double z1 = 0;  ///< zeta = z1 cos theta + z2 cos 2 theta + rise [m]
  double z2 = 0;
  double rise = 0;
};

Orbit orbit_of(const WaveField& field, const WaveComponent& wave, const Vec3& X, double t) {
  const Profile p = profile_at(field, wave, X[field.up] - field.level);
  const double a = wave.a;
  Orbit o;
  o.x1 = -a * p.c;
  o.z1 = a * p.s;
  o.rise = 0.25 * a * a * wave.k * p.s2;
  if (field.second_order) {
    o.drift = 0.5 * a * a * wave.omega * wave.k * p.c2;
    o.x2 = a * a * wave.k * (0.25 * p.S2 - 0.375 * p.c2 * p.S2);
    o.z2 = 0.375 * a * a * wave.k * p.s2 * p.S2;
  }
  o.rate = wave.k * o.drift - wave.omega;
  o.theta = wave.k * wave.along.dot(X) + o.rate * t + wave.phase;
  return o;
}

double phase_at(const WaveField& field, const WaveComponent& wave, const Vec3& x, double t) {
  return wave.k * wave.along.dot(x - field.current * t) - wave.omega * t + wave.phase;
}

/// -phi_t - |grad phi|^2/2 - g z + B of one wave, with the mean of the surface at the still level.
double bernoulli(const WaveField& field, const WaveComponent& wave, const Vec3& x, double t) {
  const double z = x[field.up] - field.level;
  const Profile p = profile_at(field, wave, z);
  const double theta = phase_at(field, wave, x, t);
  const double aw = wave.a * wave.omega;
  const double w2 = 0.75 * aw * wave.a * wave.k * p.S2;
  const double u = aw * p.c * std::cos(theta) + w2 * p.c2 * std::cos(2 * theta);
  const double w = aw * p.s * std::sin(theta) + w2 * p.s2 * std::sin(2 * theta);
  return -field.g * z + aw * wave.omega / wave.k * p.c * std::cos(theta) +
         0.75 * aw * aw * p.c2 * p.S2 * std::cos(2 * theta) - 0.5 * (u * u + w * w) +
         0.25 * aw * aw * p.S2;
}

}  // namespace

double dispersion(double k, double depth, double g) {
  return std::sqrt(g * k * std::tanh(k * depth));
}

Vec3 displacement_at(const WaveField& field, const Vec3& X, double t) {
  Vec3 d = field.current * t;
  for (const WaveComponent& wave : field.waves) {
    const Orbit o = orbit_of(field, wave, X, t);
    d += (o.x1 * std::sin(o.theta) + o.x2 * std::sin(2 * o.theta) + o.drift * t) * wave.along;
    d[field.up] += o.z1 * std::cos(o.theta) + o.z2 * std::cos(2 * o.theta) + o.rise;
  }
  return d;
}

Vec3 velocity_of(const WaveField& field, const Vec3& X, double t) {
  Vec3 v = field.current;
  for (const WaveComponent& wave : field.waves) {
    const Orbit o = orbit_of(field, wave, X, t);
    v += (o.rate * (o.x1 * std::cos(o.theta) + 2 * o.x2 * std::cos(2 * o.theta)) + o.drift) *
         wave.along;
    v[field.up] -= o.rate * (o.z1 * std::sin(o.theta) + 2 * o.z2 * std::sin(2 * o.theta));
  }
  return v;
}

Vec3 acceleration_of(const WaveField& field, const Vec3& X, double t) {
  Vec3 a = Vec3::Zero();
  for (const WaveComponent& wave : field.waves) {
    const Orbit o = orbit_of(field, wave, X, t);
    const double r2 = o.rate * o.rate;
    a -= r2 * (o.x1 * std::sin(o.theta) + 4 * o.x2 * std::sin(2 * o.theta)) * wave.along;
    a[field.up] -= r2 * (o.z1 * std::cos(o.theta) + 4 * o.z2 * std::cos(2 * o.theta));
  }
  return a;
}

double pressure_of(const WaveField& field, const Vec3& X, double t) {
  if (field.second_order) {
    return bernoulli(field, field.waves.front(), X + displacement_at(field, X, t), t);
  }
  double head = field.level - X[field.up];
  for (const WaveComponent& wave : field.waves) {
    const Profile p = profile_at(field, wave, X[field.up] - field.level);
    const Orbit o = orbit_of(field, wave, X, t);
    head += wave.a * (p.c * p.tanh_kd - p.s) * std::cos(o.theta);
  }
  return field.g * head;
}

double elevation_at(const WaveField& field, const Vec3& x, double t) {
  double eta = 0;
  for (const WaveComponent& wave : field.waves) {
    const double theta = phase_at(field, wave, x, t);
    eta += wave.a * std::cos(theta);
    if (!field.second_order) continue;
    // cosh kd (2 + cosh 2kd)/S^3 = coth kd (3 - tanh^2 kd)/(2 ... ) in terms of T = tanh kd
    const double T = std::tanh(wave.k * field.depth);
    eta += 0.25 * wave.k * wave.a * wave.a * (3 - T * T) / (T * T * T) * std::cos(2 * theta);
  }
  return eta;
}

Vec3 rest_place_of(const WaveField& field, const Vec3& x, double t) {
  Vec3 X = x - field.current * t;
  for (int n = 0; n < 200; ++n) {
    const Vec3 next = x - displacement_at(field, X, t);
    const double moved = (next - X).norm();
    X = next;
    if (moved <= 1e-15 * (1 + x.norm())) break;
  }
  return X;
}

}  // namespace gannet
