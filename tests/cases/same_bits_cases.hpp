// The cases that the tests of equal bits run.
#pragma once

#include <string>
#include <vector>

namespace gannet::test {

inline const std::string panel_slam = "cases/panel_slam/case.yaml";

/// The real case with coarser water and fewer elements, but more than one chunk of particles; and
/// with a thin skin, so that lists are made anew often.
inline const std::vector<std::string> small_panel{
    "let.dx=30mm", "parts.panel.shape.plate.elements=[16, 11]", "parts.pool.sph.skin=0.06",
    "output.checkpoint=never"};

/// The dam break with finer water: 7200 particles, more than one chunk, and its walls.
inline const std::string dam_break = "cases/dam_break_2d/case.yaml";
inline const std::vector<std::string> small_dam{"let.dx=a/60", "output.checkpoint=never"};

/// A bar of 1,890 solids that yield, four chunks of them.
inline const std::string taylor_bar = "cases/taylor_bar/case.yaml";
inline const std::vector<std::string> small_bar{"n=3", "output.checkpoint=never"};

/// A plane block of 40 x 40 quadrilaterals that yields as it hits a wall.
inline const std::string plane_block = R"case(gannet: 1
dimension: 2
materials: {metal: {density: 8930, young: 117 GPa, poisson: 0.35, yield_stress: 400 MPa, hardening_modulus: 100 MPa}}
parts:
  block:
    solid: {material: metal}
    shape: {mapped: {corners: [[0, 0, 0], [10 mm, 0, 0], [9 mm, 20 mm, 0], [1 mm, 20 mm, 0]], elements: [40, 40]}}
    initial_velocity: [0, -100 m/s, 0]
boundaries: {foot: {nodes: {plane: {point: [0, 0, 0], normal: [0, 1, 0]}, of: block}, fix: [y]}}
output: {until: 1 ms, checkpoint: never}
)case";

/// A paddle that pushes still water, 200 x 25 particles: at first all of it falls asleep but what
/// is at the paddle, then its waves wake what they meet, and that goes to sleep again.
inline const std::string resting = R"case(gannet: 1
dimension: 2
curves: {push: [[0 s, 0], [25 ms, 0], [40 ms, 1], [50 ms, 0]]}
materials: {water: {density: 1000, c0: 30 m/s}}
parts:
  pool:
    sph: {material: water, spacing: 10 mm, skin: 0.1}
    fill: {box: {from: [0, 0, 0], to: [2 m, 0.25 m, 0]}}
    start: hydrostatic
  paddle:
    wall: {like: pool, velocity: [0.1 m/s, 0, 0], factor: push}
    fill: {box: {from: [-30 mm, 0, 0], to: [0, 0.3 m, 0]}}
boundaries:
  floor: {planes: {y: 0}}
  ends: {planes: {x: [-0.5 m, 2 m]}, walls: dummy}
loads: {gravity: [0, -9.81 m/s^2, 0]}
effects:
  viscosity: {type: monaghan, alpha: 0.2}
  xsph: {epsilon: 0.3}
  density_diffusion: {delta: 0.1}
  rest: {tolerance: 3e-3, quiet: 10 ms}
probes:
  gauge: {surface_height: {at: [0.3 m]}}
  push: {wall_force: paddle}
output: {until: 10 s, checkpoint: never}
)case";

/// A shear layer in a periodic plane, 100 x 60 particles, with viscosity and XSPH, and a count of
/// what crosses a plane.
inline const std::string periodic_plane = R"(gannet: 1
dimension: 2
materials: {water: {density: 1000, c0: 30 m/s}}
parts:
  upper:
    sph: {material: water, spacing: 10 mm}
    fill: {box: {from: [0, 0.3 m, 0], to: [1 m, 0.6 m, 0]}}
    initial_velocity: [2 m/s, 0.3 m/s, 0]
  lower:
    sph: {material: water, spacing: 10 mm}
    fill: {box: {from: [0, 0, 0], to: [1 m, 0.3 m, 0]}}
    initial_velocity: [-2 m/s, 0, 0]
boundaries: {sides: {periodic: {x: [0, 1 m], y: [0, 0.6 m]}}}
effects:
  viscosity: {type: monaghan, alpha: 0.1}
  xsph: {epsilon: 0.5}
probes:
  across: {flow: {plane: {point: [0.5 m, 0.1 m, 0], normal: [1, 0, 0]}}}
  gauge: {pressure: {at: [0.5 m, 0.3 m, 0]}}
output: {until: 10 s, checkpoint: never}
)";

/// A tank that a piston, a lid in sway and gravity in time shake, 100 x 40 particles: formulas, a
/// curve, mirrors that move and that water sticks to, a plane that turns.
inline const std::string shaken_tank = R"case(gannet: 1
dimension: 2
let: {A: 20 mm, w: 30 rad/s}
curves: {pulse: [[0 s, 0], [20 ms, 3], [40 ms, -3], [80 ms, 0]]}
materials: {water: {density: 1000, c0: 30 m/s}}
parts:
  pool:
    sph: {material: water, spacing: 10 mm, skin: 0.06}
    fill: {box: {from: [0, 0, 0], to: [1 m, 0.4 m, 0]}}
    start: hydrostatic
    initial_velocity: ["0.2*sin(pi*x)", 0, 0]
    initial_pressure: "50*cos(pi*x)"
boundaries:
  piston: {planes: {x: 0}, slip: none, motion: {velocity: ["A*w*cos(w*t)", 0, 0]}}
  end: {plane: {point: [1 m, 0, 0], normal: [-1, 0, 0]}, motion: {displacement: ["A*sin(w*t)^2", 0, 0]}}
  flap: {plane: {point: [1.02 m, 0, 0], normal: [-1, 0, 0]}, motion: {rotation: {axis: [0, 0, 1], centre: [1 m, 0, 0], rate: "0.5*sin(w*t)"}}}
  floor: {planes: {y: 0}, slip: none}
loads: {gravity: ["pulse(t)", -9.81 m/s^2, 0]}
effects: {viscosity: {type: monaghan, alpha: 0.1}, xsph: {epsilon: 0.5}}
output: {until: 10 s, checkpoint: never}
)case";

/// A column that collapses with every effect of the pair passes, in single precision or with one of
/// the kernels; 4000 particles.
inline const std::vector<std::string> all_terms{"let.dx=a/45",
                                                "output.checkpoint=never",
                                                "parts.column.sph.kernel=wendland_c2",
                                                "materials.water.cavitation=-200 Pa",
                                                "materials.water.void=1e-4",
                                                "effects.viscosity.beta=0.1",
                                                "effects.laminar_viscosity.mu=0.01",
                                                "effects.tensile_cure.epsilon=0.3",
                                                "effects.density_diffusion.delta=0.1",
                                                "effects.corrected_gradients=on",
                                                "effects.free_surface.threshold=0.7",
                                                "effects.shifting.coefficient=0.5",
                                                "effects.renormalisation.every=7"};

/// A channel that repeats in x: 60 x 36 particles of water between walls of dummy particles, a
/// floor that moves, a lid that does not and a wheel that turns.
inline const std::string channel = R"case(gannet: 1
dimension: 2
materials: {water: {density: 1000, c0: 30 m/s}}
parts:
  pool:
    sph: {material: water, spacing: 10 mm}
    fill: {box: {from: [0, 0, 0], to: [0.6 m, 0.36 m, 0]}}
    initial_velocity: [0.5 m/s, 0.2 m/s, 0]
  floor:
    wall: {slip: none, velocity: [-1 m/s, 0.2 m/s, 0], factor: [[0, 0], [20 ms, 1], [60 ms, -1]]}
    fill: {box: {from: [0, -30 mm, 0], to: [0.6 m, 0, 0]}}
  wheel:
    wall: {like: pool, angular_velocity: [0, 0, 5 rad/s], centre: [0.3 m, 0.46 m, 0]}
    fill: {box: {from: [0.27 m, 0.43 m, 0], to: [0.33 m, 0.49 m, 0]}}
boundaries:
  sides: {periodic: {x: [0, 0.6 m]}}
  lid:
    plane: {point: [0, 0.55 m, 0], normal: [0, -1, 0]}
    walls: dummy
    slip: none
    motion: {displacement: [0, "-0.01*sin(20*t)", 0], rotation: {axis: [0, 0, 1], centre: [0.3 m, 0.55 m, 0], rate: "0.2*sin(30*t)"}}
probes: {under_the_lid: {pressure: {at: [0.3 m, 0.55 m, 0], on: lid}}}
loads: {gravity: [0, -9.81 m/s^2, 0]}
effects:
  viscosity: {type: monaghan, alpha: 0.1}
  xsph: {epsilon: 0.5}
output: {until: 10 s, checkpoint: never}
)case";

/// Waves of two lengths on a current over a bed that goes with them, 200 x 25 particles, with a
/// sponge and a phase of relaxation that ends half way.
inline const std::string sea = R"case(gannet: 1
dimension: 2
materials: {water: {density: 1000, c0: 20 m/s}}
parts:
  pool:
    sph: {material: water, spacing: 10 mm, skin: 0.06}
    fill: {box: {from: [0, -0.25 m, 0], to: [2 m, 0, 0]}}
    start: waves
  bed:
    wall: {motion: waves}
    fill: {box: {from: [0, -0.28 m, 0], to: [2 m, -0.25 m, 0]}}
boundaries:
  sides: {periodic: {x: [0, 2 m]}}
  beach: {sponge: {box: {from: [1 m, -9 m, 0], to: [2 m, 9 m, 0]}, ramp: 0.2 m, rate: 5 1/s, velocity: ["0.5 + t", 0, 0]}}
probes: {on_the_bed: {pressure: {at: [0.5 m, -0.25 m, 0], on: bed}}}
loads: {gravity: [0, -9.81 m/s^2, 0]}
sea: {depth: 1 m, current: [0.5 m/s, 0, 0], wave: {height: [30 mm, 10 mm], length: [1 m, 0.5 m], phase: [0, 40 deg]}}
effects:
  viscosity: {alpha: 0.05}
  relaxation: {rate: 3 1/s, until: 25 ms}
output: {until: 10 s, checkpoint: never}
)case";

/// A box that drops askew into a pool of 100 x 30 particles with friction, and one of two parts
/// that spins above it under a given motion.
inline const std::string bodies = R"case(gannet: 1
dimension: 2
materials: {water: {density: 1000, c0: 30 m/s}}
parts:
  pool:
    sph: {material: water, spacing: 10 mm, skin: 0.06}
    fill: {box: {from: [0, 0, 0], to: [1 m, 0.3 m, 0]}, outside: box}
    start: hydrostatic
  box:
    rigid_surface: {}
    shape: {polyline: {points: [[0.4, 0.27, 0], [0.6, 0.3, 0], [0.6, 0.4, 0], [0.4, 0.37, 0], [0.4, 0.27, 0]], elements: [8, 4, 8, 4]}}
  left: {rigid_surface: {mass_per_area: 3 kg/m^2}, shape: {line: {from: [0.1, 0.6, 0], to: [0.2, 0.6, 0], elements: 3}}}
  right: {rigid_surface: {mass_per_area: 2 kg/m^2}, shape: {line: {from: [0.2, 0.6, 0], to: [0.2, 0.7, 0], elements: 3}}}
bodies:
  box: {parts: box, density: 400, velocity: [0.3 m/s, -2 m/s, 0], angular_velocity: [0, 0, 3 rad/s]}
  corner: {parts: [left, right], motion: {velocity: ["sin(9*t)", free, 0], angular_velocity: [0, 0, "5*cos(20*t)"]}}
boundaries: {tank: {planes: {x: [0, 1 m], y: 0}}}
contacts: {hull: {between: [pool, box], friction: 0.2}}
loads: {gravity: [0, -9.81 m/s^2, 0]}
effects: {viscosity: {alpha: 0.1}, xsph: {epsilon: 0.3}}
probes: {box: {body: box}}
output: {until: 10 s, checkpoint: never}
)case";

/// A shell tied to the side of another and a block tied under it, each with its own mesh; the fine
/// shell in a model of its own, and one tie that lets go.
inline const std::string tied_parts = R"case(gannet: 1
materials: {steel: {density: 7800, young: 210 GPa, poisson: 0.3}}
parts:
  wing:
    shell: {material: steel, thickness: 20 mm}
    shape: {plate: {size: [1, 1], elements: [12, 12], centre: [0.5, 0.5, 0]}}
    initial_velocity: ["20*y", 0, "30*x*y"]
  strip:
    shell: {material: steel, thickness: 10 mm}
    shape: {plate: {size: [0.5, 1], elements: [20, 37], centre: [1.25, 0.5, 0]}}
    initial_velocity: [0, 0, "-40*y"]
  block:
    solid: {material: steel}
    shape: {block: {from: [0.11, 0.13, -0.2], to: [0.52, 0.61, 0], elements: [7, 8, 4]}}
ties:
  seam: {nodes: {plane: {point: [1, 0, 0], normal: [1, 0, 0]}, of: strip}, to: wing}
  glue: {nodes: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, of: block}, to: wing, breaks_at: 400 kN}
models: {coarse: {parts: [wing, block]}, fine: {parts: strip}}
loads: {gravity: [0, 0, -9.81 m/s^2]}
output: {until: 10 s, checkpoint: never}
)case";

/// The same without contact: dummy particles back the skin of the box, and water sticks to it.
inline std::string walled_bodies(std::string text) {
  const auto put = [&](const std::string& old, const std::string& with) {
    text.replace(text.find(old), old.size(), with);
  };
  put("density: 400,", "density: 400, walls: dummy, slip: none,");
  put("contacts: {hull: {between: [pool, box], friction: 0.2}}\n", "");
  return text;
}

/// The same with the box across the border of a pool that repeats.
inline std::string bodies_at_border(std::string text) {
  const auto put = [&](const std::string& old, const std::string& with) {
    text.replace(text.find(old), old.size(), with);
  };
  put("[[0.4, 0.27, 0], [0.6, 0.3, 0], [0.6, 0.4, 0], [0.4, 0.37, 0], [0.4, 0.27, 0]]",
      "[[0.85, 0.27, 0], [1.05, 0.3, 0], [1.05, 0.4, 0], [0.85, 0.37, 0], [0.85, 0.27, 0]]");
  put("velocity: [0.3 m/s, -2 m/s, 0]", "velocity: [3 m/s, -2 m/s, 0]");
  put("tank: {planes: {x: [0, 1 m], y: 0}}",
      "tank: {planes: {y: 0}}, sea: {periodic: {x: [0, 1 m]}}");
  return text;
}

/// The same with kernel contact, for which the skin of the box has nodes a spacing apart.
inline std::string kernel_bodies(std::string text) {
  const auto put = [&](const std::string& old, const std::string& with) {
    text.replace(text.find(old), old.size(), with);
  };
  put("elements: [8, 4, 8, 4]", "elements: [21, 10, 21, 10]");
  put("friction: 0.2", "type: kernel");
  return text;
}

/// A box that floats askew in a pool of 100 x 30 particles, held by two lines that are tied to it
/// and advance with it in eight or more substeps a step of the water.
inline const std::string moored = R"case(gannet: 1
dimension: 2
materials: {water: {density: 1000, c0: 30 m/s}}
parts:
  pool:
    sph: {material: water, spacing: 10 mm, skin: 0.06}
    fill: {box: {from: [0, 0, 0], to: [1 m, 0.3 m, 0]}, outside: box}
    start: hydrostatic
  box:
    rigid_surface: {}
    shape: {polyline: {points: [[0.4, 0.27, 0], [0.6, 0.3, 0], [0.6, 0.4, 0], [0.4, 0.37, 0], [0.4, 0.27, 0]], elements: [8, 4, 8, 4]}}
  left: {cable: {EA: 0.2 MN, mass_per_length: 0.5 kg/m}, shape: {line: {from: [0.1, 0.5, 0], to: [0.4, 0.37, 0], elements: 12}}}
  right: {cable: {EA: 0.2 MN, mass_per_length: 0.5 kg/m}, shape: {line: {from: [0.9, 0.5, 0], to: [0.6, 0.4, 0], elements: 12}}}
bodies: {box: {parts: box, density: 400, velocity: [0.3 m/s, -2 m/s, 0], angular_velocity: [0, 0, 3 rad/s]}}
ties:
  aft: {nodes: {nearest: [0.4, 0.37, 0], of: left}, to: box}
  fore: {nodes: {nearest: [0.6, 0.4, 0], of: right}, to: box}
models: {water: {parts: pool}, lines: {parts: [left, right]}}
boundaries:
  tank: {planes: {x: [0, 1 m], y: 0}}
  piles: {nodes: {plane: {point: [0, 0.5, 0], normal: [0, 1, 0]}, of: left}, fix: [x, y]}
  others: {nodes: {plane: {point: [0, 0.5, 0], normal: [0, 1, 0]}, of: right}, fix: [x, y]}
contacts: {hull: {between: [pool, box], friction: 0.2, damping: 0.05}}
loads: {gravity: [0, -9.81 m/s^2, 0]}
effects: {viscosity: {alpha: 0.1}, xsph: {epsilon: 0.3}}
probes: {box: {body: box}}
output: {until: 10 s, checkpoint: never}
)case";

/// The same with the forces of the water held through the substeps.
inline std::string held(std::string text) {
  const std::string lines = "lines: {parts: [left, right]}";
  return text.replace(text.find(lines), lines.size(),
                      "lines: {parts: [left, right], slow_forces: held}");
}

/// The same without contact: dummy particles back the skin of the box, and water sticks to it.
inline std::string walled(std::string text) {
  const auto put = [&](const std::string& old, const std::string& with) {
    text.replace(text.find(old), old.size(), with);
  };
  put("density: 400,", "density: 400, walls: dummy, slip: none,");
  put("contacts: {hull: {between: [pool, box], friction: 0.2, damping: 0.05}}\n", "");
  return text;
}

/// A roof of two slopes that yields as it is dented, 2,000 shells: warped, folded, thinning.
inline std::string shells(const std::string& formulation) {
  return R"case(gannet: 1
materials: {skin: {card: al_6061_t6}}
parts:
  roof:
    shell: {material: skin, thickness: 3 mm, thickness_change: yes, formulation: )case" +
         formulation + R"case(}
    shape: {wedge: {deadrise: 10 deg, half_breadth: 0.5 m, length: 1 m, elements: [25, 40]}}
    initial_velocity: ["3*sin(9*y)", "5*cos(7*x)", "60*cos(4*x)*cos(3*y)"]
boundaries: {edge: {nodes: {edge_of: roof}, fix: [x, y, z]}}
output: {until: 10 s, checkpoint: never}
)case";
}

/// Two mooring lines, of 1,300 elements that slide on the bed in a current, and of a few that
/// break.
inline const std::string moorings = R"case(gannet: 1
moorings:
  long:
    from: [900 m, 0, 310 m]
    to: [0, 0, 0]
    length: 1000 m
    EA: 1336 MN
    mass_per_length: 49.6
    diameter: 90 mm
    elements: 1300
    water: {level: 309 m, current: ["0.1*t", "0.01*z", 0], Cdt: 0.05, Cat: 0.1}
    bed: {friction: 0.4}
    motion: ["20*t", "5*t", "3*sin(50*t)"]
  short: {from: [60 m, 9 m, 40 m], to: [0, 9 m, 0], length: 72.1 m, EA: 100 MN, mass_per_length: 20, elements: 20, motion: ["40*t", 0, 0], strength: 1.5 MN}
loads: {gravity: [0, 0, -9.81 m/s^2]}
effects: {guards: off}
output: {until: 10 s, checkpoint: never}
)case";

/// A vault of quadrilaterals and triangles that yields and settles under dynamic relaxation.
inline std::string mixed_shells(const std::string& mesh_file) {
  return R"case(gannet: 1
materials: {skin: {card: al_6061_t6}}
parts:
  vault:
    shell: {material: skin, thickness: 3 mm, offset: 1 mm, damping_ratio: 0.02}
    mesh: {file: )case" +
         mesh_file + R"case(}
    map: [x, y, "0.3*x*(1 - x) + 0.02*sin(7*y)"]
    initial_velocity: ["3*sin(9*y)", "5*cos(7*x)", "60*sin(4*x)*cos(3*y)"]
boundaries: {edge: {nodes: {edge_of: vault}, fix: [x, y, z]}}
effects: {element_relaxation: {until: 10 s, motion: 1e-9}}
output: {until: 10 s, checkpoint: never}
)case";
}

/// A damped rope that swings along itself and breaks in places, and a damped beam with a hinge that
/// is bent and twisted until it yields: three chunks of each; and a strut whose fibres fail.
inline const std::string rope_and_beam = R"case(gannet: 1
materials: {iron: {density: 7800, young: 210 GPa, poisson: 0.3, yield_stress: 100 MPa, hardening_modulus: 5 GPa, kinematic_fraction: 0.5}, brittle: {density: 7800, young: 210 GPa, poisson: 0.3, johnson_cook: {A: 100 MPa, B: 200 MPa, n: 0.3, C: 0.02, m: 1, melting: 1700 K, specific_heat: 450 J/(kg*K)}, failure: {plastic_strain: 0.01}}}
parts:
  rope:
    cable: {EA: 1 MN, mass_per_length: 1, damping_ratio: 0.05, damping_time: 1e-7 s, strength: 7 kN, prestrain: 0.001}
    shape: {line: {from: [0, 0, 0], to: [12 m, 0, 0], elements: 1200}}
    initial_velocity: ["8*sin(50*x)", "2*cos(3*x)", 0]
  beam:
    beam:
      material: iron
      section: {box: {width: 50 mm, height: 80 mm, wall: 5 mm}}
      damping_ratio: 0.05
      releases: {hinge: {nodes: {nearest: [3 m, 1 m, 0], of: beam}, axes: y}}
    shape: {polyline: {points: [[0, 1 m, 0], [3 m, 1 m, 0], [6 m, 1 m, 3 m]], elements: [300, 290]}}
    mass_scaling: {step: 2 us, ceiling: 20 %}
    initial_velocity: ["3*sin(x)", "5*sin(2*x)", "4*cos(7*x)"]
  strut:
    beam: {material: brittle, section: {solid_round: {diameter: 20 mm}}}
    shape: {line: {from: [0, 2 m, 0], to: [6 m, 2 m, 0], elements: 300}}
    initial_velocity: ["40*sin(9*x)", "20*sin(30*x)", 0]
boundaries: {clamp: {nodes: {nearest: [0, 1 m, 0], of: beam}, fix: [x, y, z, rx, ry, rz]}}
output: {until: 10 s, checkpoint: never}
)case";

/// Rubber, and metals with all that they can have: a rod of copper that warms and fails at a wall,
/// a bar with a yield surface that moves, and a sheet with a hardening curve, drawn out until
/// elements leave.
inline const std::string metals = R"case(gannet: 1
materials:
  copper:
    density: 8960
    young: 124 GPa
    poisson: 0.34
    johnson_cook: {A: 90 MPa, B: 292 MPa, n: 0.31, C: 0.025, m: 1.09, melting: 1331 K, specific_heat: 383 J/(kg*K)}
    failure: {johnson_cook: [0.05, 0.2, -3.03, 0.014, 1.12]}
  steel: {density: 7800, young: 210 GPa, poisson: 0.3, yield_stress: 300 MPa, hardening_modulus: 3 GPa, kinematic_fraction: 0.5, cowper_symonds: {D: 40.4 1/s, p: 5}}
  gum: {density: 1100, yeoh: {C10: 0.5 MPa, C20: -0.02 MPa, C30: 0.002 MPa, poisson: 0.49}}
  plate:
    density: 7800
    young: 210 GPa
    poisson: 0.3
    hardening_curve: {plastic_strain: [0, 0.01, 0.1], stress: [300 MPa, 380 MPa, 450 MPa]}
    failure: {plastic_strain: 0.02}
parts:
  rod:
    solid: {material: copper}
    shape: {rod: {from: [0, 0, 0], to: [0, 0, 32.4 mm], radius: 3.2 mm, elements: [3, 3, 42]}}
    initial_velocity: [0, 0, -227 m/s]
  bar:
    solid: {material: steel, formulation: eight_points, damping_ratio: 0.1}
    shape: {block: {from: [0.1 m, 0, 0], to: [0.2 m, 10 mm, 10 mm], elements: [60, 6, 6]}}
    initial_velocity: ["60*cos(30*x)", "20*sin(90*x)", 0]
  gate:
    solid: {material: gum, formulation: eight_points}
    shape: {block: {from: [0.3 m, 0, 0], to: [0.4 m, 10 mm, 10 mm], elements: [40, 6, 6]}}
    initial_velocity: ["10*cos(30*x)", "2*sin(90*x)", 0]
  pad:
    solid: {material: gum, damping_time: 1e-7 s}
    shape: {block: {from: [0.3 m, 0.1 m, 0], to: [0.4 m, 0.11 m, 10 mm], elements: [40, 6, 6]}}
    initial_velocity: ["10*cos(30*x)", "2*sin(90*x)", 0]
  sheet:
    shell: {material: plate, thickness: 1 mm, thickness_change: yes, damping_ratio: 0.05}
    shape: {plate: {size: [0.1 m, 0.1 m], elements: [50, 50], centre: [0, 0.2 m, 0]}}
    initial_velocity: ["1500*x*abs(x)/0.03", "20*sin(90*x)", "30*cos(50*y)"]
boundaries:
  wall: {nodes: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, of: rod}, fix: [z]}
output: {until: 10 s, checkpoint: never}
)case";

/// Two blocks of meshes that do not fit and a sheet over them that touch from the start, slide,
/// part and meet again: more than one chunk of nodes on each, friction and damping. They stand on a
/// floor that moves, and so does a rigid block.
inline const std::string blocks_that_meet = R"case(gannet: 1
materials: {gum: {density: 1100, young: 20 MPa, poisson: 0.4}, alu: {density: 2700, young: 70 GPa, poisson: 0.3}}
parts:
  low:
    solid: {material: gum}
    shape: {block: {from: [0, 0, 0], to: [0.2 m, 0.2 m, 30 mm], elements: [20, 20, 3]}}
    initial_velocity: ["2*y", "-2*x", "5*sin(30*x)"]
  high:
    solid: {material: gum, formulation: tetrahedra}
    shape: {block: {from: [13 mm, -20 mm, 30 mm], to: [0.17 m, 0.16 m, 50 mm], elements: [14, 13, 2]}}
    initial_velocity: [3 m/s, 0, "-20 - 100*x"]
  sheet:
    shell: {material: alu, thickness: 1 mm}
    shape: {plate: {size: [0.15 m, 0.15 m], elements: [17, 19], centre: [0.1 m, 0.07 m, 50.4 mm]}}
    initial_velocity: [0, -5 m/s, -40 m/s]
  lump:
    solid: {material: alu}
    shape: {block: {from: [0.3 m, 0, 0.1 mm], to: [0.4 m, 0.2 m, 40 mm], elements: [10, 20, 4]}}
bodies: {lump: {parts: lump, velocity: [1 m/s, 0, -3 m/s], angular_velocity: [3 rad/s, 5 rad/s, 2 rad/s]}}
boundaries: {floor: {planes: {z: 0}, motion: {velocity: ["2*sin(2e4*t)", "1 + 3e3*t", "3*sin(3e4*t)"]}}}
contacts:
  on_floor: {between: [low, floor], friction: 0.2, damping: 0.1}
  landing: {between: [floor, lump], friction: 0.2, damping: 0.1}
  lower: {between: [low, high], friction: 0.3}
  upper: {between: [sheet, high], friction: 0.1, damping: 0.2}
  through: {between: [low, sheet]}
output: {until: 10 s, checkpoint: never}
)case";

/// Two blocks that meet; one of them is rigid up to then, and again after a while.
inline const std::string rigid_and_back = R"case(gannet: 1
materials: {gum: {density: 1100, young: 20 MPa, poisson: 0.4}}
parts:
  low:
    solid: {material: gum}
    shape: {block: {from: [0, 0, 0], to: [0.2, 0.2, 0.05], elements: [16, 16, 4]}}
  high:
    solid: {material: gum}
    shape: {block: {from: [0.03, 0.02, 0.0505], to: [0.15, 0.14, 0.12], elements: [12, 12, 6]}}
bodies: {high: {parts: high, velocity: [0, 0, -10], angular_velocity: [3, 5, 40], rigid: {until_contact: yes, again_from: 1.2 ms}}}
contacts: {hit: {between: [low, high], friction: 0.2}}
output: {until: 10 s, checkpoint: never}
)case";

}  // namespace gannet::test
