#include "fe/catenary.hpp"

#include <algorithm>
#include <cmath>

namespace gannet {

namespace {

double positive_part(double x) { return x > 0 ? x : 0; }

CatenaryPoint free_point(const Catenary& c, double s) {
  const double w = c.line.weight;
  const double Va = c.V - w * c.line.length;
  const double Vs = Va + w * s;
  CatenaryPoint p;
  p.x = c.H / w * (std::asinh(Vs / c.H) - std::asinh(Va / c.H)) + c.H * s / c.line.EA;
  p.z = (std::hypot(c.H, Vs) - std::hypot(c.H, Va)) / w + (Va * s + 0.5 * w * s * s) / c.line.EA;
  p.tension = std::hypot(c.H, Vs);
  return p;
}

/// On and above a bed; LB: length on it, D = LB - H/(C_B w), from where on friction has left a
/// pull.
CatenaryPoint bed_point(const Catenary& c, double s) {
  const double w = c.line.weight;
  const double EA = c.line.EA;
  const double CB = c.line.friction;
  const double LB = c.on_bed();
  const double D = CB > 0 ? LB - c.H / (CB * w) : 0;
  const double D_plus = CB > 0 ? positive_part(D) : 0;
  CatenaryPoint p;
  if (s <= LB) {
    p.tension = CB > 0 ? positive_part(c.H - CB * w * (LB - s)) : c.H;
    p.x = s;
    if (CB == 0) {
      p.x += c.H * s / EA;
    } else if (s > D) {
      p.x += CB * w / (2 * EA) * (s * s - 2 * D * s + D * D_plus);
    }
    return p;
  }
  const double Vs = w * (s - LB);
  p.x = LB + c.H / w * std::asinh(Vs / c.H) + c.H * s / EA +
        CB * w / (2 * EA) * (D * D_plus - LB * LB);
  p.z = (std::hypot(c.H, Vs) - c.H) / w + Vs * Vs / (2 * EA * w);
  p.tension = std::hypot(c.H, Vs);
  return p;
}

/// The root of a rising f in [a, b], f(a) <= 0 <= f(b), by false position with halved weights
/// (Illinois), bisected where that gains too little.
template <class F>
double root_between(F&& f, double a, double b) {
  double fa = f(a);
  double fb = f(b);
  for (int k = 0; k < 200 && b - a > 1e-15 * std::abs(b) && fa < 0 && fb > 0; ++k) {
    double m = k % 4 == 3 ? 0.5 * (a + b) : (a * fb - b * fa) / (fb - fa);
    if (!(m > a && m < b)) m = 0.5 * (a + b);
    if (!(m > a && m < b)) break;
    const double fm = f(m);
    const bool left = fm < 0;
    (left ? a : b) = m;
    (left ? fa : fb) = fm;
    (left ? fb : fa) *= 0.5;
    if (fm == 0) return m;
  }
  return fa == 0 ? a : b;
}

/// The catenary of a given H whose upper end is Z above the anchor.
Catenary with_height(Catenary c, double H, double Z) {
  c.H = H;
  const double wL = c.line.weight * c.line.length;
  const auto miss = [&](double V) {
    c.V = V;
    return point_at(c, c.line.length).z - Z;
  };
  double low = c.line.bed ? 0 : -wL;
  double high = wL + H;
  while (miss(low) > 0 && !c.line.bed) low *= 2;
  while (miss(high) < 0) high *= 2;
  c.V = root_between(miss, low, high);
  return c;
}

}  // namespace

double Catenary::on_bed() const {
  return line.bed ? positive_part(line.length - V / line.weight) : 0;
}

CatenaryPoint point_at(const Catenary& catenary, double s) {
  return catenary.on_bed() > 0 ? bed_point(catenary, s) : free_point(catenary, s);
}

std::optional<Catenary> catenary_between(const CatenaryLine& line, double X, double Z) {
  if (!(line.weight > 0) || !(X > 0) || (line.bed && Z < 0)) return std::nullopt;
  Catenary c;
  c.line = line;
  const auto miss = [&](double log_H) {
    c = with_height(c, std::exp(log_H), Z);
    return point_at(c, line.length).x - X;
  };
  const double scale = line.weight * line.length;
  const double low = std::log(1e-6 * scale);
  double high = std::log(scale + line.EA * 1e-3);
  if (miss(low) > 0) return std::nullopt;
  while (miss(high) < 0) high += 1;
  miss(root_between(miss, low, high));
  return c;
}

}  // namespace gannet
