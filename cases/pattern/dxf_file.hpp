#pragma once
/// What stands in a DXF file, as far as flat patterns need it: read by libdime in a process of its own.

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/apart.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// A drawn thing. Coordinates are in the file's unit, in the single precision that libdime has (6e-8 of their size).
struct DxfEntity {
  enum class Kind : int { polyline, point, circle, text, insert, other };
  Kind kind = Kind::other;
  std::string type;   ///< "POLYLINE"
  std::string layer;  ///< "1"
  /// Polylines (LINE and ARC are polylines of two points; SPLINE and ELLIPSE of many): points, and tan(angle / 4) of
  /// the arc that follows each. Circles: the centre. Texts, inserts: where they stand.
  std::vector<Vec2> points;
  std::vector<double> bulges;
  bool closed = false;
  std::string text;  ///< of a text; of an insert the block's name
  double size = 0;   ///< radius of a circle; z of a point
  std::array<double, 3> scale{1, 1, 1};
  double rotation_deg = 0;
};

struct DxfBlock {
  std::string name;
  std::vector<DxfEntity> entities;
};

struct DxfFile {
  int insert_units = 0;  ///< $INSUNITS; 0: not said
  int measurement = -1;  ///< $MEASUREMENT: 0 English, 1 metric; -1: not said
  std::vector<DxfBlock> blocks;
  std::vector<DxfEntity> entities;
};

/// Throws InputError, which names the file, where it is no DXF or ends its reader (readApart).
DxfFile readDxfFile(const std::filesystem::path& file);

}  // namespace gambeson
