#pragma once
/// The scripts and the style beside this file, and the libraries that they need, as they were when this was built
/// (analysis/CMakeLists.txt).

#include <string_view>

namespace gambeson::viewer {

struct Sources {
  std::string_view style, script;  ///< ours
  std::string_view three, orbit;   ///< three.js and its OrbitControls
  std::string_view notice;         ///< the licence of these
};
Sources sources();

}  // namespace gambeson::viewer
