// An order in which points that are near in space are near in the list.
#pragma once

#include <span>
#include <vector>

#include "base/array.hpp"
#include "base/math.hpp"

namespace gannet {

/// The points in the order of a Hilbert curve through the smallest cube around them:
/// result[k] is the index of the point that comes k-th. Points of a plane or line that is normal
/// to an axis follow the curve of that plane or line. Ties go by index, so the order depends on
/// nothing but the points. points: n x 3 [m], finite. Throws nothing.
/// The transform between axes and curve is that of J. Skilling, Programming the Hilbert curve,
/// AIP Conf. Proc. 707 (2004), written from its description: per bit, from the highest, exchange
/// or invert the lower bits of an axis and the first one, then undo the Gray code.
std::vector<Index> curve_order(std::span<const Vec3> points);

}  // namespace gannet
