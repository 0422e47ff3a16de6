#include "app/effects.hpp"

#include <vector>

#include "body/effects.hpp"
#include "contact/effects.hpp"
#include "fe/effects.hpp"
#include "mesh/mesh_keys.hpp"
#include "output/output.hpp"
#include "scene/draft.hpp"
#include "sph/effects.hpp"
#include "study/hard_case.hpp"
#include "study/study_file.hpp"
#include "time/guards.hpp"
#include "time/leapfrog.hpp"
#include "time/models_effect.hpp"

namespace gannet {

namespace {

/// Keys that belong to no effect.
Schema case_schema() {
  return {{"", {.name = "title", .kind = Kind::text, .text = "what the case is"}},
          {"",
           {.name = "dimension",
            .kind = Kind::integer,
            .text = "3, or 2 for the plane z = 0 of unit thickness",
            .fallback = "3",
            .limits = between(2, 3)}},
          {"parts.*", initial_velocity_key()}};
}

std::vector<Effect> make_table() {
  return {
      leapfrog_effect(),    // first: clears forces, kicks and drifts
      models_effect(),      //
      tie_places_effect(),  // nodes are where they are tied before elements take their shape
      gravity_effect(),     // says what gravity is before others ask the scene
      sponge_effect(),      // after the free kick, before motions that are given
      relaxation_effect(),  // likewise
      element_relaxation_effect(),
      part_damping_effect(),
      planes_effect(),         //
      plane_motion_effect(),   // before lists are made: planes are where they are by then
      wall_pressure_effect(),  // what the force pass of the particles reads
      sph_effect(),            //
      rest_effect(),           // who is computed, right after the lists
      viscosity_effect(),      //
      laminar_viscosity_effect(),
      tensile_cure_effect(),
      density_diffusion_effect(),
      corrected_gradients_effect(),
      xsph_effect(),
      free_surface_effect(),
      shifting_effect(),  // after XSPH: both move particles in the drift
      renormalisation_effect(),
      cavities_effect(),
      walls_effect(),               // built around the particles; follows their passes
      sea_effect(),                 // carries what fills and walls have made
      shell_effect(),               //
      solid_effect(),               //
      cable_effect(),               //
      moorings_effect(),            //
      beam_effect(),                //
      rigid_bodies_effect(),        // takes the masses of the elements, and gathers their forces
      rigid_phases_effect(),        // which bodies are not these; see below for their motion
      mass_scaling_effect(),        // what those elements have made of it
      rigid_surface_effect(),       //
      displaced_fill_effect(),      // when all parts have their points
      carried_walls_effect(),       // likewise; before contacts: their links have the weight
      plane_contact_effect(),       //
      contacts_effect(),            //
      part_contacts_effect(),       //
      kernel_contacts_effect(),     //
      pressure_effect(),            //
      nodal_force_effect(),         //
      acceleration_effect(),        //
      ties_effect(),                // nodes that bodies take over
      periodic_effect(),            // copies out what moved, adds back what ghosts collected
      mirror_walls_effect(),        // images at walls; adds to what planes measure
      prescribed_motion_effect(),   // after all forces: measures the reactions
      rigid_phase_motion_effect(),  // likewise: what nodes do together, once they are kicked
      tie_motion_effect(),          // of what is tied, after what it is tied to
      probes_effect(),              //
      wall_force_effect(),
      flow_probes_effect(),
      sph_probes_effect(),  //
      guards_effect(),      // after all energies are known
      study_effect(),       // keys only: what `gannet study` varies and measures
      hard_effect(),        // keys only: limits that `gannet hard` holds a case to
      output_effect(),      // last: looks at everything, changes nothing
  };
}

}  // namespace

std::span<const Effect> effects() {
  static const std::vector<Effect> table = make_table();
  return table;
}

Schema whole_schema() {
  Schema schema = case_schema();
  const auto append = [&](const Schema& more) {
    schema.insert(schema.end(), more.begin(), more.end());
  };
  append(mesh_schema());
  for (const Effect& e : effects()) {
    if (e.schema != nullptr) append(e.schema());
  }
  return schema;
}

}  // namespace gannet
