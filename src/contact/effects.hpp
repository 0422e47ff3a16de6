// The effects of this room, for the table of effects.
#pragma once

#include "plan/effect.hpp"

namespace gannet {

/// Particles against the rigid planes of the scene: always there where both are.
Effect plane_contact_effect();

/// contacts.NAME: {between, type: node_to_segment, friction, thickness, stiffness, damping}.
Effect contacts_effect();

/// contacts.NAME between two parts of elements.
Effect part_contacts_effect();

/// ties.NAME: nodes that hang on rigid bodies. Stands after `rigid bodies`, whose groups it adds
/// to.
Effect ties_effect();

}  // namespace gannet
