/// Detail of fields_sheet.hpp: built shapes of a sheet: a few numbers and directions each.

#include <fmt/format.h>

#include "cases/structure/fields_sheet.hpp"

namespace gambeson::schema::sheet {
namespace {

constexpr double pi = std::numbers::pi;

void checkRightAngle(const Entry& p, const Vec3& a, const Vec3& b, const char* key, const char* other) {
  if (!(std::abs(dot(a, b)) < 1e-6)) p.failAt(key, fmt::format("is not at right angles to {}; allowed: 90 deg", other));
}

void checkTurn(const Entry& p, double start, double end, const char* key) {
  const double turn = end - start;
  if (!(turn > 1e-6 && turn <= 2 * pi * (1 + 1e-9)))
    p.failAt(key, fmt::format("{} rad beyond the start is out of range; allowed: > 0 and <= 2 pi", turn));
}

}  // namespace

Object plateTable() {
  using S = PlateShape;
  return Table<S>("Plate")
      .number("width", &S::width_m, "m", size, "length along axis_u")
      .required()
      .number("height", &S::height_m, "m", size, "length along axis_v")
      .required()
      .vector("corner", &S::corner, "m", world, "the corner u0v0 in the world")
      .direction("axis_u", &S::axis_u, "direction of u")
      .direction("axis_v", &S::axis_v, "direction of v; at right angles to axis_u")
      .check([](const Entry& p, const S& s) { checkRightAngle(p, s.axis_v, s.axis_u, "axis_v", "axis_u"); })
      .build();
}

Object cylinderTable() {
  using S = CylinderShape;
  return Table<S>("Cylinder")
      .number("radius", &S::radius_m, "m", size, "radius")
      .required()
      .number("length", &S::length_m, "m", size, "length along the axis, the direction of v")
      .required()
      .number("start_angle", &S::start_angle_rad, "rad", between(-7, 7),
              "angle at the edge u0, right-handed about axis from zero")
      .number("end_angle", &S::end_angle_rad, "rad", between(-7, 14),
              "angle at the edge u1; a full turn closes the tube, which then has no edges u0 and u1")
      .vector("start", &S::start, "m", world, "centre of the circle v0")
      .direction("axis", &S::axis, "direction of the axis, from v0 to v1")
      .direction("zero", &S::zero, "from the axis to the line of angle 0; at right angles to axis")
      .check([](const Entry& p, const S& s) {
        checkTurn(p, s.start_angle_rad, s.end_angle_rad, "end_angle");
        checkRightAngle(p, s.zero, s.axis, "zero", "axis");
      })
      .build();
}

Object sphereTable() {
  using S = SphereShape;
  return Table<S>("Sphere")
      .number("radius", &S::radius_m, "m", size, "radius")
      .required()
      .number("longitude_start", &S::longitude_start_rad, "rad", between(-7, 7),
              "longitude at the edge u0, right-handed about axis from zero")
      .number("longitude_end", &S::longitude_end_rad, "rad", between(-7, 14),
              "longitude at the edge u1; a full turn closes the zone, which then has no edges u0 and u1")
      .number("latitude_start", &S::latitude_start_rad, "rad", between(-1.57, 1.57),
              "latitude at the edge v0; 0 is the equator")
      .number(
          "latitude_end", &S::latitude_end_rad, "rad", between(-1.57, 1.57),
          "latitude at the edge v1; a pole itself cannot be part of the sheet (1.57 rad leave a hole of 0.0008 radius)")
      .required()
      .vector("center", &S::center, "m", world, "centre")
      .direction("axis", &S::axis, "from the south pole to the north pole")
      .direction("zero", &S::zero, "from the axis to longitude 0; at right angles to axis")
      .check([](const Entry& p, const S& s) {
        checkTurn(p, s.longitude_start_rad, s.longitude_end_rad, "longitude_end");
        if (!(s.latitude_end_rad - s.latitude_start_rad > 1e-6))
          p.failAt("latitude_end", fmt::format("{} rad is out of range; allowed: above latitude_start = {} rad",
                                               s.latitude_end_rad, s.latitude_start_rad));
        checkRightAngle(p, s.zero, s.axis, "zero", "axis");
      })
      .build();
}

Object annulusTable() {
  using S = AnnulusShape;
  return Table<S>("Annulus")
      .number("inner_radius", &S::inner_radius_m, "m", size, "radius of the edge u0")
      .required()
      .number("outer_radius", &S::outer_radius_m, "m", size, "radius of the edge u1")
      .required()
      .number("start_angle", &S::start_angle_rad, "rad", between(-7, 7),
              "angle at the edge v0, right-handed about normal from zero")
      .number("end_angle", &S::end_angle_rad, "rad", between(-7, 14),
              "angle at the edge v1; a full turn closes the ring, which then has no edges v0 and v1")
      .vector("center", &S::center, "m", world, "centre")
      .direction("normal", &S::normal, "normal of the ring")
      .direction("zero", &S::zero, "direction of angle 0; at right angles to normal")
      .check([](const Entry& p, const S& s) {
        if (!(s.outer_radius_m > s.inner_radius_m * (1 + 1e-9)))
          p.failAt("outer_radius", fmt::format("{} m is out of range; allowed: above inner_radius = {} m",
                                               s.outer_radius_m, s.inner_radius_m));
        checkTurn(p, s.start_angle_rad, s.end_angle_rad, "end_angle");
        checkRightAngle(p, s.zero, s.normal, "zero", "normal");
      })
      .build();
}

}  // namespace gambeson::schema::sheet
