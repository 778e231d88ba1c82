#include "core/cloth/draft/garment.hpp"

#include "core/cloth/draft/fields.hpp"
#include "core/error.hpp"
#include "core/material/fabric_law.hpp"
#include "core/nurbs/nurbs.hpp"

namespace gambeson {

void checkGarment(const Garment& garment) {
  if (!garment.garment_of_patch.empty() && garment.garment_of_patch.size() != garment.patches.size())
    throw InputError({"", 0, "garment_of_patch"}, "one number for each patch is needed");
  checkFabric(garment.fabric);
  for (std::size_t k = 0; k < garment.other_fabrics.size(); ++k)
    checkFabric(garment.other_fabrics[k], ("other_fabrics[" + std::to_string(k) + "]").c_str());
  if (garment.weft.size() != garment.patches.size())
    throw InputError({"", 0, "weft"}, "one direction for each patch is needed");
  for (const NurbsPatch& patch : garment.patches) validate(patch);
  validateFields(garment);
}

}  // namespace gambeson
