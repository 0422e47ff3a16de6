#include "fe/shell_keys.hpp"

#include <utility>

namespace gannet {

namespace {

std::vector<Key> own_keys() {
  const std::vector<Key> hourglass{
      {.name = "type",
       .kind = Kind::choice,
       .text = "stiffness: an elastic force that remembers; viscous: a damping force",
       .fallback = "stiffness",
       .choices = {"stiffness", "viscous"}},
      {.name = "coefficient",
       .text = "strength of the hourglass control, customarily 0.01 to 0.05",
       .fallback = "0.03",
       .limits = between(0, 0.15)}};
  return {
      {.name = "material",
       .kind = Kind::reference,
       .text = "solid that the shell is made of",
       .required = true,
       .refers_to = "materials"},
      {.name = "thickness",
       .unit = dim::length,
       .text = "thickness of the shell",
       .required = true,
       .limits = positive()},
      {.name = "points",
       .kind = Kind::integer,
       .text = "points through the thickness; unless said 5, or 3 where the solid is elastic",
       .limits = between(1, max_shell_points)},
      {.name = "formulation",
       .kind = Kind::choice,
       .text = "belytschko_lin_tsay: one point in the plane, fast, with hourglass control; "
               "fully_integrated: 2 x 2 points and assumed shear, accurate",
       .fallback = "belytschko_lin_tsay",
       .choices = {"belytschko_lin_tsay", "fully_integrated"}},
      {.name = "hourglass",
       .kind = Kind::map,
       .text = "control of the modes that one point of integration does not see",
       .keys = hourglass},
      {.name = "thickness_change",
       .kind = Kind::flag,
       .text = "the thickness follows the stretching of the shell",
       .fallback = "no"},
      {.name = "collapse",
       .kind = Kind::choice,
       .text = "what happens where an element has shrunk to nothing or turned inside out",
       .fallback = "stop",
       .choices = {"stop", "erode"}},
      {.name = "collapse_ratio",
       .text = "area over area at the start at which an element has collapsed",
       .fallback = "0.01",
       .limits = {.lowest = 0, .highest = 1, .lowest_open = true, .highest_open = true}},
      {.name = "offset",
       .unit = dim::length,
       .text = "distance of the middle of the shell from its nodes, along the normals",
       .fallback = "0"},
      {.name = "section_forces",
       .kind = Kind::flag,
       .text = "show membrane forces, bending moments and shear forces in VTK",
       .fallback = "no"},
      {.name = "warping",
       .kind = Kind::flag,
       .text = "elements whose corners lie in no plane bend as they should (warping correction)",
       .fallback = "yes"},
      {.name = "dt_factor",
       .text = "share of the stable step of the elements that is used",
       .fallback = "0.9",
       .limits = {.lowest = 0, .highest = 1, .lowest_open = true}}};
}

}  // namespace

std::vector<Key> shell_keys() {
  std::vector<Key> keys = own_keys();
  for (Key& key : stiffness_damping_keys()) keys.push_back(std::move(key));
  return keys;
}

ShellSection read_shell_section(const Keys& shell, const ElasticPlastic& material) {
  ShellSection section;
  section.thickness = shell.number("thickness");
  if (shell.has("formulation") && shell.word("formulation") == "fully_integrated") {
    section.kind = ShellKind::quad;
    for (const char* key : {"hourglass", "warping"}) {
      if (shell.given(key)) {
        shell.complain(key, "has no meaning where shells are fully integrated");
      }
    }
  }
  section.points = shell.has("points") ? shell.integer("points") : (material.plastic() ? 5 : 3);
  if (shell.has("hourglass")) {
    const Keys hourglass = shell.map("hourglass");
    if (hourglass.has("type") && hourglass.word("type") == "viscous") {
      section.hourglass = HourglassForm::viscous;
    }
    section.hourglass_coefficient =
        hourglass.number_or("coefficient", section.hourglass_coefficient);
  }
  section.offset = shell.number_or("offset", 0);
  section.damping = read_stiffness_damping(shell);
  section.smallest_ratio = shell.number_or("collapse_ratio", section.smallest_ratio);
  section.thickness_changes = shell.has("thickness_change") && shell.flag("thickness_change");
  section.warping = !shell.has("warping") || shell.flag("warping");
  section.dt_factor = shell.number_or("dt_factor", section.dt_factor);
  return section;
}

}  // namespace gannet
