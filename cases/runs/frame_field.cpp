#include "cases/runs/frame_field.hpp"

#include "core/error.hpp"

namespace gambeson {

const Field& fieldOf(const Frame& frame, const std::string& name) {
  for (const Field& f : frame.sample_fields)
    if (f.name == name) return f;
  throw RunError("the recording has no field \"" + name + "\"");
}

}  // namespace gambeson
