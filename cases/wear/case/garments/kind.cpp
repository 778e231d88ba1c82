#include "cases/wear/case/garments/kind.hpp"

#include <array>
#include <variant>

namespace gambeson {

extern const GarmentKind sheet_garment, disc_garment, tube_garment, shorts_garment, trousers_garment, belt_garment,
    shirt_garment, skirt_garment, file_garment, mesh_file_garment, pattern_garment;

std::span<const GarmentKind* const> garmentKinds() {
  static constexpr std::array kinds{&sheet_garment,    &disc_garment,      &tube_garment,   &shorts_garment,
                                    &trousers_garment, &belt_garment,      &shirt_garment,  &skirt_garment,
                                    &file_garment,     &mesh_file_garment, &pattern_garment};
  static_assert(kinds.size() == std::variant_size_v<decltype(GarmentCase::shape)>);
  return kinds;
}

const GarmentKind& kindOf(const GarmentCase& g) { return *garmentKinds()[g.shape.index()]; }

}  // namespace gambeson
