// What a case says of its mooring lines.
#pragma once

#include <vector>

#include "base/keys.hpp"
#include "base/schema.hpp"
#include "fe/mooring.hpp"

namespace gannet {

/// The keys of moorings.NAME.
Schema mooring_schema();

/// Gravity at the start [m/s^2].
Vec3 gravity_of(const Keys& root);

/// The lines of the case, those with names and those of a line file of MoorDyn: ends, elements,
/// water and bed, with what is chosen where nothing is said (choose_bed()). Complains of those that
/// cannot be, and leaves them out.
std::vector<MooringLine> read_moorings(const Keys& root);

/// Stiffness and damping of a bed where the case does not say them: a line that lies on it sinks in
/// by a tenth of its diameter, and its bounce is damped critically. g: gravity, downwards [m/s^2].
void choose_bed(MooringLine& line, double g);

}  // namespace gannet
