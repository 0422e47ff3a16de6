#include "sph/sph_operations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

#include "sph/neighbour_lists.hpp"
#include "sph/pair_pass.hpp"
#include "sph/stable_step.hpp"

namespace gannet {

void pack_for_force(SphState& sph, const Scene& scene) {
  ParticleView view = view_of(sph, scene);
  view.p = sph.p.data();
  if (!sph.v_seen.empty()) view.v = sph.v_seen.data();
  pack_particles(view, sph.kernel.reach(), sph.packed);
  sph.packed_pressures = true;
}

namespace {

/// The results that a term asks for: the array that its effect made, or null.
template <class T>
T* wanted(Array<T>& results) {
  return results.empty() ? nullptr : results.data();
}

ForceOut force_out(SphState& sph, Scene& scene) {
  return {.f = scene.nodes.f.data() + scene.particles.begin,
          .f_viscous = wanted(sph.f_viscous),
          .f_laminar = wanted(sph.f_laminar),
          .f_tensile = wanted(sph.f_tensile),
          .f_correction = wanted(sph.f_correction)};
}

RatesOut rates_out(SphState& sph) {
  return {.drho_dt = sph.drho_dt.data(),
          .X = sph.terms.epsilon > 0 ? sph.X.data() : nullptr,
          .drho_diffusion = wanted(sph.drho_diffusion),
          .drho_correction = wanted(sph.drho_correction),
          .concentration = wanted(sph.concentration)};
}

/// "pressure", "pressure and viscosity", "pressure, viscosity and correction"
std::string in_words(const std::vector<std::string>& terms) {
  std::string text = terms.front();
  for (std::size_t k = 1; k < terms.size(); ++k) {
    text += (k + 1 == terms.size() ? " and " : ", ") + terms[k];
  }
  return text;
}

/// A term of a pass: its name, what it writes, and whether it is on.
struct Term {
  const char* name;
  const char* writes;
  bool on;
};

/// Names and results of the terms that are on.
struct Terms {
  std::vector<std::string> names;
  std::vector<std::string> writes;
};

/// stable_step() of particle k alone, with its own speed of sound and rate of compression.
double stable_step_of(const SphState& sph, const Scene& scene, Index k) {
  const Murnaghan& eos = eos_of(sph, scene, k);
  const double c2 = eos.gamma * (sph.p[k] - eos.p0 + eos.B) / sph.rho[k];
  const double mu = sph.h * std::max(sph.drho_dt[k] / sph.rho[k], 0.0);
  const Damping damping{sph.terms.alpha * sph.c0 + 2 * sph.terms.beta * mu, sph.terms.mu / sph.rho0,
                        sph.terms.delta * sph.c0};
  return stable_step(sph.limits, sph.cfl, sph.h, std::sqrt(c2),
                     largest_damping(sph.limits, sph.h, damping));
}

Terms terms_on(std::initializer_list<Term> all) {
  Terms terms;
  for (const Term& term : all) {
    if (!term.on) continue;
    terms.names.emplace_back(term.name);
    terms.writes.emplace_back(term.writes);
  }
  return terms;
}

/// The n smallest steps that particles allow, each with its own speed of sound and compression; of
/// equal ones the smaller id first. The vote takes the extremes of both over all particles, and so
/// is at most the first of them.
std::vector<Vote> smallest_votes(const SphState& sph, const Scene& scene, std::size_t n) {
  struct One {
    double dt;
    std::int64_t id;
    Index k;
  };
  std::vector<One> all;
  for (Index k = 0; k < scene.particles.size(); ++k) {
    const auto i = static_cast<std::size_t>(scene.particles.begin + k);
    all.push_back({stable_step_of(sph, scene, k), static_cast<std::int64_t>(scene.nodes.id[i]), k});
  }
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(n, all.size()));
  std::partial_sort(all.begin(), end, all.end(), [](const One& a, const One& b) {
    return std::tie(a.dt, a.id) < std::tie(b.dt, b.id);
  });
  std::vector<Vote> votes;
  for (auto one = all.begin(); one != end; ++one) {
    votes.push_back({one->dt, text_of_particle(scene, one->k)});
  }
  return votes;
}

void add_force(SphState& sph, Scene& scene, Plan& plan, const std::string& reason) {
  plan.add({.name = "pack particles for the force",
            .reason =
                "rule: a pair pass reads one line a particle, of 64 bytes (32 in single precision)",
            .stage = Stage::force,
            .reads = {"x", "v", "rho", "p"},
            .run = [&](const Step&) { pack_for_force(sph, scene); }});
  const Terms terms = terms_on({{"pressure", "f", true},
                                {"viscosity", "f_viscous", !sph.f_viscous.empty()},
                                {"laminar viscosity", "f_laminar", !sph.f_laminar.empty()},
                                {"tensile repulsion", "f_tensile", !sph.f_tensile.empty()},
                                {"corrected gradient", "f_correction", !sph.f_correction.empty()}});
  plan.add({.name = "particle pair pass: " + in_words(terms.names),
            .reason = reason,
            .stage = Stage::force,
            .reads = {"x", "v", "rho", "p"},
            .writes = terms.writes,
            .run =
                [&](const Step&) {
                  pair_force(sph.list, sph.packed, parameters_of(sph), force_out(sph, scene),
                             {.rho = sph.rho.data()});
                },
            .stable_dt =
                [&] {
                  sph.vote = smallest_stable_step(sph, scene);
                  if (sph.vote.particle >= 0) {
                    sph.limited_by = text_of_particle(scene, sph.vote.particle);
                  }
                  return sph.vote.dt;
                },
            .limited_by = [&] { return sph.limited_by; },
            .smallest = [&](std::size_t n) { return smallest_votes(sph, scene, n); }});
}

std::string skin_in_words(const ListSkin& skin) {
  if (skin.least == skin.most) return fmt::format("{:.3g} m", skin.least);
  return fmt::format("{:.3g} to {:.3g} m by how fast that is", skin.least, skin.most);
}

void add_lists(SphState& sph, Scene& scene, Plan& plan) {
  plan.add({.name = "neighbour lists",
            .reason = "rule: made anew when neighbours may have moved by the skin of the lists, " +
                      skin_in_words(sph.skin) + ", relative to each other",
            .stage = Stage::half_drift,
            .reads = {"x", "v"},
            .writes = {"x_build", "list_skin", "order of particles"},
            .owns = {"x_build", "list_skin"},
            .run = [&](const Step& step) { renew_lists(sph, scene, 0.5 * step.dt); }});
}

void add_rates(SphState& sph, Scene& scene, Plan& plan, const std::string& reason) {
  plan.add({.name = "pack particles for the rates",
            .reason =
                "rule: a pair pass reads one line a particle, of 64 bytes (32 in single precision)",
            .stage = Stage::rates,
            .reads = {"x", "v", "rho"},
            .run = [&](const Step&) {
              ParticleView view = view_of(sph, scene);
              view.s = wanted(sph.s);
              pack_particles(view, sph.kernel.reach(), sph.packed);
              sph.packed_pressures = false;
            }});
  const Terms terms =
      terms_on({{"density rate", "drho_dt", true},
                {"XSPH", "X", sph.terms.epsilon > 0},
                {"density diffusion", "drho_diffusion", !sph.drho_diffusion.empty()},
                {"concentration", "concentration", !sph.concentration.empty()},
                {"corrected divergence", "drho_correction", !sph.drho_correction.empty()}});
  plan.add({.name = "particle pair pass: " + in_words(terms.names),
            .reason = reason,
            .stage = Stage::rates,
            .reads = {"x", "v", "rho"},
            .writes = terms.writes,
            .owns = {"drho_dt"},
            .run = [&](const Step&) {
              pair_rates(sph.list, sph.packed, parameters_of(sph), rates_out(sph),
                         {.rho = sph.rho.data()});
            }});
  plan.add({.name = "density and pressure",
            .reason = reason,
            .stage = Stage::rates,
            .reads = {"drho_dt"},
            .writes = {"rho", "p"},
            .owns = {"rho", "p"},
            .run = [&](const Step& step) { advance_density(sph, scene, step.dt); }});
}

void add_look(SphState& sph, Scene& scene, Models& models, const std::string& reason,
              bool watch_sound_speed) {
  Plan& plan = models.of_node(scene.particles.begin).plan;
  std::vector<LedgerEntry*> entries;
  for (const int part : sph.parts) {
    entries.push_back(&models.ledger.entry("internal", scene.parts[part].name));
  }
  plan.add({.name = "internal energy of particles",
            .reason = reason,
            .stage = Stage::look,
            .reads = {"rho"},
            .run = [&, entries](const Step&) {
              for (std::size_t k = 0; k < entries.size(); ++k) {
                entries[k]->value = internal_energy_at_work(sph, scene, sph.parts[k]);
              }
            }});
  if (!watch_sound_speed) return;
  plan.add(
      {.name = "check of the speed of sound",
       .reason = "rule: every 100 steps, until it warns; sph.sound_speed_check: off takes it out",
       .stage = Stage::look,
       .reads = {"v", "rho"},
       .run = [&](const Step& step) {
         if (sph.warned || step.n % 100 != 0) return;
         const std::string warning = sound_speed_warning(sph, scene, step.dt);
         if (warning.empty()) return;
         scene.warnings.push_back(fmt::format("t = {:.6g} s: {}", step.t, warning));
         sph.warned = true;
       }});
}

}  // namespace

void sum_shepard(SphState& sph, const Scene& scene, double* sum_mW, double* sum_VW) {
  pack_particles(view_of(sph, scene), sph.kernel.reach(), sph.packed);
  pair_rates(sph.list, sph.packed, parameters_of(sph), {.sum_mW = sum_mW, .sum_VW = sum_VW});
}

void add_particle_operations(SphState& sph, Scene& scene, Models& models, const std::string& reason,
                             bool watch_sound_speed) {
  Plan& plan = models.of_node(scene.particles.begin).plan;
  // The first force pass needs lists: all states are there by now, so sorting permutes them all.
  rebuild_lists(sph, scene);
  add_force(sph, scene, plan, reason);
  add_look(sph, scene, models, reason, watch_sound_speed);
  add_lists(sph, scene, plan);
  add_rates(sph, scene, plan, reason);
}

}  // namespace gannet
