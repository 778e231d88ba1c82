#pragma once
/// The field tables of what worn garments and sheets of structures have alike.

#include "cases/input/schema.hpp"

namespace gambeson::schema {

Object fabricTable();       ///< FabricInput, see fabric_input.hpp
Object strainLimitTable();  ///< StrainLimitCase
enum class FieldsOf { sheet, garment };
Object fieldsTable(FieldsOf of);  ///< FieldsCase
Object noiseTable();              ///< NoiseCase
Object regionsTable();            ///< RegionCase

}  // namespace gambeson::schema
