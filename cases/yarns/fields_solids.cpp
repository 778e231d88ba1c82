/// Detail of fields.hpp: the table of solid yarns.

#include <fmt/format.h>

#include "cases/input/table.hpp"
#include "cases/yarns/fields.hpp"

namespace gambeson::schema {

Object solidsTable() {
  using S = SolidsCase;
  const auto mesh = [](auto member) {
    return [member](auto& s) -> auto& { return s.mesh.*member; };
  };
  return Table<S>("Solid yarns")
      .integer("across", mesh(&YarnMeshing::across), 2, 16,
               "hexahedra of a section, in both of its directions: across^2 of them")
      .integer("along", mesh(&YarnMeshing::along), 5, 63,
               "hexahedra of a yarn from the middle between two crossings to the next such middle, an odd number: with "
               "even ones nodes of one yarn stand on edges of the other")
      .choice("contact_method", &S::method,
              std::vector<std::pair<std::string, SolidContactMethod>>{{"augmented", SolidContactMethod::augmented},
                                                                      {"penalty", SolidContactMethod::penalty},
                                                                      {"multipliers", SolidContactMethod::multipliers}},
              "how yarns are kept from passing through each other (Man 2006, 3.1.2). augmented: penalties whose "
              "pressures are kept and solved for again until they stay (boxes 6 and 7); penalty: once, which lets some "
              "pass; multipliers: none pass, by a set of pairs that is tried, without friction")
      .choice("friction_bound", &S::bound,
              std::vector<std::pair<std::string, FrictionBound>>{{"symmetrised", FrictionBound::symmetrised},
                                                                 {"coupled", FrictionBound::coupled}},
              "which pressure limits friction while forces are being balanced: that of the pass before (box 7), or the "
              "one that is sought (box 6); penalty knows the latter alone")
      .number("penalty", &S::penalty, "", aboveTo(0, 1e6),
              "stiffness of contact, by Young's modulus across over half the thickness, of the softer yarn")
      .integer("iterations", &S::iterations, 1, 1000, "Newton iterations of a pass")
      .integer("passes", &S::passes, 1, 1000, "augmentations of a step, or sets of pairs that are tried")
      .number("change", &S::change, "", between(1e-12, 0.1),
              "augmented: by how much pressures may change in the last pass, of the largest")
      .number("deepest", &S::deepest, "", between(1e-12, 0.5),
              "augmented: how far a node may have passed then, of half the thickness of the thinner yarn")
      .check([](const Entry& p, const S& s) {
        if (s.mesh.along % 2 == 0)
          p.failAt("along", fmt::format("{} is even; allowed: odd numbers from 5 to 63", s.mesh.along));
      })
      .build();
}

}  // namespace gambeson::schema
