// The frames of a run's output folder, read back from its VTK files.
#pragma once

#include <string>
#include <vector>

#include "base/math.hpp"
#include "output/run_record.hpp"

namespace gannet {

/// The frames that a .pvd names, in its order.
struct Series {
  std::string name;    ///< of the .pvd, without its ending
  std::string folder;  ///< that the paths of the files start from
  std::vector<Frame> frames;
};

/// Reads the one .pvd of a folder, or the .pvd `path` itself. Throws InputError where there is
/// none, more than one, or one that cannot be read or names no frame.
Series read_series(const std::string& path);

/// A part as points and flat pieces. Particles have no pieces.
struct DrawnPart {
  std::string name;
  bool particles = false;
  std::vector<Vec3> points;  ///< [m]
  struct Piece {
    std::vector<Index> corners;  ///< of points; 2: an edge, 3 or more: a face
    Index cell = 0;
  };
  std::vector<Piece> pieces;
  /// Of each point (particles) or cell (elements); empty where the part has no such quantity.
  std::vector<double> values;
};

struct DrawnFrame {
  double t = 0;  ///< [s]
  std::vector<DrawnPart> parts;
};

/// A quantity that can be shown: `speed` is |Velocity|; any array of the files goes by its name, in
/// small letters, words split by '_' or not: pressure, density, plastic_strain, thickness, ...
/// Of three components the length is shown, of six (a stress) the equivalent stress of von Mises
///   sqrt(((xx-yy)^2 + (yy-zz)^2 + (zz-xx)^2)/2 + 3 (xy^2 + yz^2 + xz^2))
struct Shown {
  std::string label;  ///< "speed", "plastic strain"
  std::string array;  ///< to compare with the names of arrays: small letters only
  std::string unit;   ///< SI; empty where unknown or none
};
Shown shown_quantity(const std::string& name);

/// Reads all parts of a frame with the values of a quantity. Throws InputError where a file cannot
/// be read, or where no part has the quantity: the message lists what there is.
DrawnFrame read_frame(const Series& series, const Frame& frame, const Shown& shown);

}  // namespace gannet
