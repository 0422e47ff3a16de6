#include "contact/track_contact.hpp"

#include <utility>

namespace gannet {

namespace {

void add_vector(Scene& scene, const std::string& name, const std::function<Vec3()>& f) {
  scene.measures.push_back({name, "N", {"x", "y", "z"}, [f](double* out) {
                              const Vec3 v = f();
                              for (int k = 0; k < 3; ++k) out[k] = v[k];
                            }});
}

void add_number(Scene& scene, const std::string& name, const char* unit,
                const std::function<double()>& f) {
  scene.measures.push_back({name, unit, {"value"}, [f](double* out) { *out = f(); }});
}

}  // namespace

void track_contact(Scene& scene, const std::string& name, std::vector<Field> fields,
                   const ContactTold& told) {
  const std::string prefix = "contact." + name + ".";
  for (Field& f : fields) {
    f.name = prefix + f.name;
    f.owner = "contact " + name;
    scene.fields.push_back(std::move(f));
  }
  add_vector(scene, prefix + "force", told.force);
  if (told.viscous_force) add_vector(scene, prefix + "viscous_force", told.viscous_force);
  add_number(scene, prefix + "active", "1",
             [active = told.active] { return static_cast<double>(active()); });
  if (told.numbers == nullptr) return;
  const auto number = [&told](std::size_t k) {
    return [numbers = told.numbers, k] { return (*numbers)[k]; };
  };
  add_number(scene, prefix + "overlaps", "1", number(told.overlaps));
  add_number(scene, prefix + "overlap_depth", "m", number(told.overlaps + 1));
}

}  // namespace gannet
