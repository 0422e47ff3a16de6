// One part at one level as a VTK XML file.
#pragma once

#include <string>

#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// "vtp" for particles, "vtu" for elements.
const char* vtk_extension(const Part& part);

/// Writes the part `part` (its number) at level n as the file `path`: a .vtp (particles: points and
/// one poly-vertex cell) or a .vtu (elements, nodes renumbered from 0). The file has its name only
/// when it is complete.
/// Inline base64 with LZ4 and 64-bit headers, because ParaView 5.11 of Debian 12 cannot read
/// appended data; numbers keep all their bits. Arrays:
/// - every field with a VTK name that the part's nodes, particles or cells have, in the order of
///   scene.fields; v and omega are shifted from n+1/2 to n as velocity_at_level() says;
/// - GlobalIds of points and cells;
/// - TimeValue, the time of the level [s], as field data.
/// Six components are taken as xx, yy, zz, xy, yz, xz of a symmetric tensor.
/// step: of the model that holds the part. Must be called in the look stage, after the kick.
/// Throws std::runtime_error where the file cannot be written.
void write_vtk(const Scene& scene, int part, const Step& step, const std::string& path);

}  // namespace gannet
