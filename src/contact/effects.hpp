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

/// contacts.NAME of `type: kernel`: {between, stiffness, exponent}.
Effect kernel_contacts_effect();

/// ties.NAME to a part that deforms: stands before the elements, which take their shape from nodes
/// that it moves, and before all that adds forces, which links collect.
Effect tie_places_effect();

/// The motion of such nodes: stands after motions that are given.
Effect tie_motion_effect();

/// ties.NAME: nodes that hang on rigid bodies. Stands after `rigid bodies`, whose groups it adds
/// to.
Effect ties_effect();

}  // namespace gannet
