/// Detail of kind.hpp: a garment from a file of patches.

#include "cases/input/table.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "tryon/pattern/garment_file.hpp"

namespace gambeson {
namespace schema {
namespace {

Object fileTable() {
  return Table<FileGarment>("Garment file")
      .path("path", &FileGarment::path, "file with patches and seams, relative to the case's folder")
      .required()
      .build();
}

}  // namespace
}  // namespace schema

extern const GarmentKind file_garment;
const GarmentKind file_garment{
    .word = "file",
    .addTo =
        [](schema::Table<GarmentCase>& table) {
          table.alternative<FileGarment>("file", &GarmentCase::shape, schema::fileTable(), "a garment from a file");
        },
    .make = [](const GarmentMaking& m) { return loadGarment(std::get<FileGarment>(m.worn.shape).path); },
    .look = [](const GarmentCase& g) { return loadGarment(std::get<FileGarment>(g.shape).path); },
    .files = [](GarmentCase& g, const GarmentKind::Take& take) { take(std::get<FileGarment>(g.shape).path); },
};

}  // namespace gambeson
