#include "body/body_mass_keys.hpp"

#include <fmt/format.h>

namespace gannet {

namespace {

/// The closed surface of all parts of a body; empty after a mistake, which is noted.
ClosedSurface surface_of(const Keys& keys, const Scene& scene, const std::vector<int>& parts) {
  ClosedSurface surface{.dimension = scene.dimension};
  for (const int number : parts) {
    const Part& part = scene.parts[static_cast<std::size_t>(number)];
    std::vector<Vec3> points;
    for (Index i = part.nodes.begin; i < part.nodes.end; ++i) {
      points.push_back(xyz(scene.nodes.x[static_cast<std::size_t>(i)]));
    }
    std::vector<Index> cells(part.connectivity.begin(), part.connectivity.end());
    for (Index& i : cells) i -= part.nodes.begin;
    const bool solid = part.cell == Cell::tetrahedron || part.cell == Cell::hexahedron ||
                       (scene.dimension == 2 && part.cell == Cell::quad);
    add_boundary(points, cells, nodes_per(part.cell), solid, surface);
  }
  const std::string why_not = close_surface(surface);
  if (why_not.empty()) return surface;
  keys.complain("density", "the surface of the parts " + why_not);
  return {};
}

Mat3 inertia_of(const Keys& keys, int dimension) {
  const std::vector<double>& I = keys.numbers("inertia");
  const std::size_t wanted = dimension == 2 ? 1 : 6;
  if (I.size() != wanted) {
    keys.complain("inertia", dimension == 2
                                 ? "one number is wanted in the plane: Izz"
                                 : fmt::format("{} numbers; six are wanted: [Ixx, Iyy, Izz, Ixy, "
                                               "Ixz, Iyz]",
                                               I.size()));
    return Mat3::Identity();
  }
  Mat3 m;
  if (dimension == 2) return I[0] * Mat3::Identity();
  m << I[0], I[3], I[4], I[3], I[1], I[5], I[4], I[5], I[2];
  return m;
}

std::string words_of(const Scene& scene, const std::vector<int>& parts) {
  std::string names;
  for (const int p : parts) {
    names += (names.empty() ? "" : ", ") + scene.parts[static_cast<std::size_t>(p)].name;
  }
  return names;
}

/// Puts what the case says in the place of what follows from the nodes.
void take_given(const Keys& keys, const Scene& scene, BodyMass& m) {
  const bool alone = m.mass > 0;  // the nodes have masses
  const Vec3 centre = m.centre;
  if (keys.has("mass")) {
    if (alone) m.inertia *= keys.number("mass") / m.mass;
    m.mass = keys.number("mass");
  }
  if (keys.has("centre")) m.centre = keys.vector("centre");
  if (keys.has("inertia")) {
    m.inertia = inertia_of(keys, scene.dimension);
  } else if (keys.has("centre") && alone && (m.centre - centre).norm() > 1e-9) {
    keys.complain(
        "centre",
        fmt::format("another one than that of the parts' masses, ({:.6g}, {:.6g}, {:.6g}) "
                    "m, wants an 'inertia' beside it",
                    centre.x(), centre.y(), centre.z()));
  } else if (!alone && keys.has("mass")) {
    keys.complain("mass",
                  "the parts have no mass that could be scaled: 'inertia' and 'centre' are "
                  "wanted beside it, or 'density' in its place");
  }
  if (!alone && keys.has("mass") && keys.has("inertia") && !keys.has("centre")) {
    keys.complain("mass", "the parts have no mass that a centre would follow from; say 'centre'");
  }
}

}  // namespace

std::vector<Key> body_mass_keys() {
  return {{.name = "mass",
           .unit = dim::mass,
           .text = "unless said, that of the parts; in the plane for a thickness of 1 m",
           .limits = positive()},
          {.name = "density",
           .unit = dim::density,
           .text = "of a homogeneous body inside the closed surface of the parts, in place of mass",
           .limits = positive()},
          {.name = "centre",
           .kind = Kind::vector,
           .unit = dim::length,
           .text = "centre of mass; unless said, that of the parts"},
          {.name = "inertia",
           .kind = Kind::numbers,
           .unit = dim::inertia,
           .text = "about the centre along the axes of space: [Ixx, Iyy, Izz, Ixy, Ixz, Iyz] with "
                   "Ixy = -sum m x y; in the plane Izz alone"}};
}

std::optional<WeighedBody> weigh_body(const Keys& keys, const Scene& scene,
                                      const std::vector<int>& parts,
                                      const std::vector<Index>& members,
                                      const std::vector<Index>& tied) {
  const std::size_t n_mistakes = keys.mistakes().messages().size();
  WeighedBody body;
  if (keys.has("density")) {
    for (const char* key : {"mass", "centre", "inertia"}) {
      if (keys.has(key)) keys.complain(key, "stands beside 'density', from which it follows");
    }
    const ClosedSurface surface = surface_of(keys, scene, parts);
    if (surface.facets.empty()) return {};
    body = {mass_inside(surface, keys.number("density")),
            "homogeneous inside the surface of " + words_of(scene, parts)};
  } else {
    body = {mass_of_nodes(scene.nodes, members),
            "the masses of the nodes of " + words_of(scene, parts)};
    take_given(keys, scene, body.of);
  }
  if (keys.mistakes().messages().size() > n_mistakes) return {};
  body.of = with_nodes(body.of, scene.nodes, tied);
  if (!tied.empty()) body.rule += ", with the nodes tied to it";
  if (scene.dimension == 2) flatten(body.of);
  if (!(body.of.mass > 0)) {
    keys.complain("", "the parts have no mass; say 'density', or 'mass', 'centre' and 'inertia'");
    return {};
  }
  if (least_inertia(body.of) > 0) return body;
  keys.complain(keys.has("inertia") ? "inertia" : "parts",
                "the inertia is not positive definite: about some axis nothing resists a rotation");
  return {};
}

}  // namespace gannet
