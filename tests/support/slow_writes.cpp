// Linked into an executable, this makes its writes slow: see output/files.hpp.
#include "output/files.hpp"

namespace gannet {

bool writes_are_slow() { return true; }

}  // namespace gannet
