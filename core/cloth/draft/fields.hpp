#pragma once
/// What varies over a patch: thickness, material and fibre angle as functions of the parameters (Zheng 2013, outlook
/// 5).

#include <optional>
#include <vector>

#include "core/material/fabric.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

struct Garment;

/// A scalar over the unit square, which stands for the parameter range of a patch: a tensor B-spline of one degree (0:
/// a value per rectangle, 1: bilinear between a grid of points, 2 and 3: smooth) on uniform open knots.
/// values[i + count_u j]; each count is at least degree + 1.
struct PatchField {
  int degree = 1;
  int count_u = 1, count_v = 1;
  std::vector<double> values;
};

/// Throws InputError (key = what is wrong) unless degree is 0 to 3, counts fit and values are finite.
void validate(const PatchField& field);
/// The value at fractions (s, t) of the range, clamped to [0, 1].
double fieldAt(const PatchField& field, Vec2 st);

/// The fields of one patch. Where one is absent the fabric stays as it is.
struct PatchFields {
  std::optional<PatchField> thickness;    ///< thickness over that of the fabric, > 0
  std::optional<PatchField> fibre_angle;  ///< turns the weft direction about the normal [rad]
  /// Which material: k is the garment's fabric for k = 0, else its other_fabrics[k - 1]; between whole numbers the two
  /// neighbours' plane-stress stiffness [Pa], thickness, density, rigidities and (eq. 2.14) kappa_0 are mixed linearly.
  std::optional<PatchField> material;
};

/// The fabric at parameters (u, v) of a patch, thickness and material fields applied. With f the thickness factor,
/// moduli stay, so membrane resultants and the surface density go with f; given bending and twist rigidities are those
/// of the nominal thickness and go with f^3 (a homogeneous or bonded sheet), as the consistent law and laminates do of
/// themselves; kappa_0 stays.
/// A mixture of laminates, or of a laminate and a fabric, is refused when the garment is validated.
Fabric fabricAt(const Garment& garment, int patch, Vec2 uv);
/// The surface density of fabricAt at the same place [kg/m^2].
double surfaceDensityAt(const Garment& garment, int patch, Vec2 uv);
/// The angle by which the weft is turned about the normal [rad].
double fibreAngleAt(const Garment& garment, int patch, Vec2 uv);
/// Whether the fabric (angle apart) differs from point to point of a patch.
bool fabricVaries(const Garment& garment, int patch);
/// The one fabric of a patch where there is one: 0 the garment's, else that of other_fabrics before it.
std::optional<int> fabricOfPatch(const Garment& garment, int patch);
/// Throws InputError (key "fields[patch]...") where fields do not fit the garment: counts, ranges over the whole patch.
void validateFields(const Garment& garment);

}  // namespace gambeson
