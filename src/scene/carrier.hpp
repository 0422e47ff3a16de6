// Rigid bodies as others know them that push them or let particles ride on them: who makes a body
// keeps how it moves, who carries particles on it says what pushes these.
#pragma once

#include <algorithm>
#include <deque>
#include <string>

#include "base/array.hpp"
#include "base/math.hpp"

namespace gannet {

/// One body. Everything but force and moment is kept by who makes it.
struct Carrier {
  std::string name;
  Index node = -1;                             ///< its centre of mass; -1: not made yet
  Quaternion q = Quaternion::Identity();       ///< from its frame to space at level n
  Quaternion q_next = Quaternion::Identity();  ///< the same at n+1, from the kick on
  double inverse_mass = 0;                     ///< [1/kg]
  double softest = 0;                          ///< least principal moment of inertia [kg m^2]
  Mat3 inverse_inertia = Mat3::Zero();         ///< in its frame [1/(kg m^2)]
  Vec3 force = Vec3::Zero();                   ///< on what it carries, at level n [N]
  Vec3 moment = Vec3::Zero();                  ///< the same about the centre [N m]

  /// The largest acceleration that a unit force on a point of it gives that point, 1/M + r^2/I_min
  /// [1/kg]. arm: from the centre [m].
  [[nodiscard]] double inverse_mass_at(const Vec3& arm) const {
    return inverse_mass + arm.squaredNorm() / softest;
  }
};

/// All bodies of a case: scene.store.get<Carriers>(). An entry never moves.
struct Carriers {
  std::deque<Carrier> list;

  [[nodiscard]] Carrier* find(const std::string& name) {
    const auto found = std::ranges::find(list, name, &Carrier::name);
    return found == list.end() ? nullptr : &*found;
  }
};

}  // namespace gannet
