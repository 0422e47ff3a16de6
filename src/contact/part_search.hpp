// When two parts of a contact are looked at, and which of their nodes and segments.
#pragma once

#include "contact/part_contact.hpp"

namespace gannet {

/// Makes sure that the lists of a contact are complete for this level. Parts whose boxes are apart
/// have no lists and are not looked at again for as many steps as they need to meet, at twice their
/// speed of now and at no less than a tenth of an element a step. Returns false where there is
/// nothing near. wait: receives that number of steps. With lists, the places and areas of both
/// surfaces are those of this level.
bool look_for_pairs(const Scene& scene, PartContact& contact, const Step& step, double& wait);

/// The lists from the positions in x_search and the skin in `numbers`. Between solids a node is
/// paired with segments that face it only: one on an edge does not take the side of the other for
/// its front.
void make_part_lists(PartContact& contact);

}  // namespace gannet
