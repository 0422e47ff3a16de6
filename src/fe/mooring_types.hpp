// Kinds of mooring lines whose properties follow from a nominal size.
#pragma once

#include <span>
#include <string>

#include "base/keys.hpp"
#include "base/schema.hpp"
#include "fe/mooring.hpp"

namespace gannet {

/// What a kind of line has, d its nominal diameter (of the bar of a chain, of a rope) in metres:
///   mass per length  mass d^2          EA = EA_2 d^2 + EA_3 d^3
///   diameter of a cylinder that displaces as much water  displaces d
///   least breaking load  breaks_1 d + breaks_2 d^2 + breaks_3 d^3
/// drag and added mass on that diameter. Figures: NREL's MoorPy, MoorProps_default.yaml; there
/// mass, stiffness and breaking load of chains after DNV-OS-E301 and makers' catalogues (breaking
/// load of grade R4), drag after DNV-OS-E301, added mass after Bureau Veritas NR 493. Fibre ropes
/// have their quasi-static stiffness, a multiple of the breaking load; under waves they are
/// stiffer.
struct MooringType {
  const char* name;
  double largest;  ///< size that is made, and that the figures are for [m]
  double mass;     ///< [kg/m^3]
  double EA_2, EA_3;
  double displaces;
  double breaks_1, breaks_2, breaks_3;
  double Cdn, Cdt, Can, Cat;
};

/// All of them.
std::span<const MooringType> mooring_types();

/// The keys `type` and `nominal`.
Key mooring_type_key();
Key nominal_key();

/// Gives a line the stiffness, mass and diameter of its `type` and size. Does nothing where there
/// is no `type`. Complains and returns false where it lacks its size, or what it says is said
/// again.
bool read_mooring_type(const Keys& keys, MooringLine& line);

/// Gives the water around a line of a `type` the coefficients that the case leaves open.
void read_coefficients_of_type(const Keys& keys, LineWater& water);

/// The type of a line of a case; nullptr where it names none.
const MooringType* type_of_line(const Keys& keys);

/// Least breaking load of a line of that size [N]. d: [m].
double breaking_load(const MooringType& type, double d);

}  // namespace gannet
