// What this program is; revision.cpp is written by the build.
#pragma once

namespace gannet {

const char* version();   ///< "0.1.0"
const char* revision();  ///< of git, "+" behind it where files were changed; may be empty

}  // namespace gannet
