// What a case says of its mooring lines.
#pragma once

#include "base/keys.hpp"
#include "base/schema.hpp"
#include "fe/mooring.hpp"

namespace gannet {

/// The keys of moorings.NAME.
Schema mooring_schema();

/// Gravity at the start [m/s^2].
Vec3 gravity_of(const Keys& root);

/// One line of the case: ends, elements, water and bed, with what is chosen where nothing is said
/// (bed_choice()). Complains and returns false where it cannot be.
bool read_mooring(const Keys& root, const Keys& keys, MooringLine& line);

/// Stiffness and damping of a bed where the case does not say them: a line that lies on it sinks in
/// by a tenth of its diameter, and its bounce is damped critically. g: gravity, downwards [m/s^2].
void choose_bed(MooringLine& line, double g);

}  // namespace gannet
