// The elastic catenary between an anchor and a point above it, with or without a flat sea bed: the
// closed form that a line at rest starts from.
#pragma once

#include <optional>

namespace gannet {

/// A uniform line.
struct CatenaryLine {
  double length = 0;    ///< unstretched, L > 0 [m]
  double weight = 0;    ///< in water, per unstretched length, w > 0 [N/m]
  double EA = 0;        ///< > 0 [N]
  double friction = 0;  ///< of the bed, C_B >= 0
  bool bed = false;     ///< a flat bed at the height of the anchor, else none
};

/// The line in its vertical plane, x from the anchor towards the upper end, z upwards.
struct Catenary {
  CatenaryLine line;
  double H = 0;  ///< horizontal force at the upper end [N]
  double V = 0;  ///< vertical force at the upper end, upwards [N]
  /// Unstretched length on the bed, L - V/w; 0 without a bed [m].
  [[nodiscard]] double on_bed() const;
};

/// A point of the line.
struct CatenaryPoint {
  double x = 0;        ///< from the anchor [m]
  double z = 0;        ///< above the anchor [m]
  double tension = 0;  ///< [N]
};

/// The point at the unstretched distance s from the anchor, 0 <= s <= L. With a bed and V < wL the
/// forms of Jonkman 2007 (NREL/TP-500-41958, eqs. 2-35 to 2-38), else those of Irvine 1981 (Cable
/// Structures):
///   x = H/w [asinh((Va + w s)/H) - asinh(Va/H)] + H s/EA,  Va = V - w L
///   z = H/w [sqrt(1 + ((Va + w s)/H)^2) - sqrt(1 + (Va/H)^2)] + (Va s + w s^2/2)/EA
/// Needs H > 0.
CatenaryPoint point_at(const Catenary& catenary, double s);

/// The catenary whose upper end is X beside and Z above the anchor [m]: Z is met for each H, X by
/// H, both monotone and bracketed, to rounding. None where no pull is left to hold it (the line
/// hangs straight down and lies slack), and for X or w not above 0. With a bed Z must not be
/// negative.
std::optional<Catenary> catenary_between(const CatenaryLine& line, double X, double Z);

}  // namespace gannet
