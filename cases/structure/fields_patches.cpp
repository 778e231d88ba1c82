/// Detail of fields_sheet.hpp: patches of one's own, written out or in a file.

#include <fmt/format.h>

#include "cases/structure/fields_sheet.hpp"
#include "core/error.hpp"

namespace gambeson::schema::sheet {
namespace {

const std::vector<std::pair<std::string, SeamKind>> seam_kinds{{"G1", SeamKind::G1}, {"C0", SeamKind::C0}};

Object patchTable() {
  using P = NurbsPatch;
  Field degree = fieldOf("degree", Kind::numbers, "", between(1, 5), "degree of u and of v, such as [2, 2]");
  degree.required = true;
  Field points = fieldOf("points", Kind::lists, "m", world, "control points [x, y, z], u fastest");
  points.required = true;
  const auto knots = [](const char* key, const char* along) {
    Field f = fieldOf(key, Kind::numbers, "", any(),
                      fmt::format("knots along {}, not falling; as many as control points + degree + 1", along));
    f.required = true;
    return f;
  };
  return Table<P>("Patch")
      .custom(
          degree,
          [](const Entry& p, P& patch) {
            if (p.node.type != JsonNode::Type::list || p.node.children.size() != 2)
              p.fail("expected two whole numbers [of u, of v], not " + describe(p.node));
            patch.u.degree = readInteger(p.item(0), between(1, 5));
            patch.v.degree = readInteger(p.item(1), between(1, 5));
          },
          [](const P& patch) {
            return std::optional(nodeOfList({double(patch.u.degree), double(patch.v.degree)}));
          })
      .custom(
          knots("knots_u", "u"), [](const Entry& p, P& patch) { patch.u.knots = readNumbers(p, "", any()); },
          [](const P& patch) { return std::optional(nodeOfList(patch.u.knots)); })
      .custom(
          knots("knots_v", "v"), [](const Entry& p, P& patch) { patch.v.knots = readNumbers(p, "", any()); },
          [](const P& patch) { return std::optional(nodeOfList(patch.v.knots)); })
      .custom(
          points, [](const Entry& p, P& patch) { patch.points = readPoints<Vec3>(p, readVector); },
          [](const P& patch) { return std::optional(nodeOfPoints(patch.points)); })
      .custom(
          [] {
            Field f = fieldOf("weights", Kind::numbers, "", aboveTo(0, 1e9), "weights of the control points");
            f.default_note = "all 1";
            return f;
          }(),
          [](const Entry& p, P& patch) { patch.weights = readNumbers(p, "", aboveTo(0, 1e9)); },
          [](const P& patch) { return std::optional(nodeOfList(patch.weights)); })
      .check([](const Entry& p, P& patch) {
        if (patch.weights.empty()) patch.weights.assign(patch.points.size(), 1.0);
        try {
          validate(patch);
        } catch (const InputError& e) {
          p.fail((e.where().key.empty() ? "" : e.where().key + ": ") + e.reason());
        }
      })
      .build();
}

Object seamTable() {
  using S = SeamCase;
  const auto edge = [](const char* key, PatchEdge Seam::*member) {
    Field f = fieldOf(key, Kind::text, "", any(), "a patch and its side, such as 0.u1");
    f.required = true;
    return std::tuple(
        f,
        [member](const Entry& p, S& s) {
          const EdgeAt e = readEdgeAt(p);
          if (e.patch < 0) p.fail("a seam names the patch as well; allowed: such as 0.u1");
          (s.seam.*member).patch = e.patch;
          (s.seam.*member).side = e.side;
        },
        [member](const S& s) {
          return std::optional(nodeOf(EdgeAt{(s.seam.*member).patch, (s.seam.*member).side}));
        });
  };
  const auto [fa, ra, wa] = edge("a", &Seam::a);
  const auto [fb, rb, wb] = edge("b", &Seam::b);
  return Table<S>("Seam")
      .custom(fa, ra, wa)
      .custom(fb, rb, wb)
      .flag(
          "reversed", [](auto& s) -> auto& { return s.seam.b.reversed; }, "b runs against a")
      .choice(
          "kind", [](auto& x) -> auto& { return x.seam.kind; }, seam_kinds,
          "G1: tangents joined as well, for smooth shapes with a constant ratio of the tangents' lengths; C0: joined "
          "by position, a hinge with the given stiffness")
      .number(
          "stiffness", [](auto& x) -> auto& { return x.seam.stiffness_N; }, "N/rad", between(0, 1e12),
          "rotational spring: moment per length and angle")
      .flag(
          "weak", &S::weak,
          "for edges whose knots, degrees or weights differ, or of which one lies on a part of the other: joined by a "
          "penalty; G1 then keeps the angle between the patches")
      .build();
}

}  // namespace

Object nurbsTable() {
  using S = NurbsShape;
  return Table<S>("Patches")
      .list("patches", &S::patches, patchTable(), "the patches")
      .required()
      .list("seams", &S::seams, seamTable(),
            "how they are joined: edges with the same degree, knots and weights (others: weak)")
      .check([](const Entry& p, const S& s) {
        if (s.patches.empty()) p.failAt("patches", "there is none; allowed: at least one");
        for (std::size_t i = 0; i < s.seams.size(); ++i)
          for (const int patch : {s.seams[i].seam.a.patch, s.seams[i].seam.b.patch})
            if (patch >= static_cast<int>(s.patches.size()))
              p.member(*p.node.find("seams"))
                  .item(i)
                  .fail(fmt::format("there is no patch {}; allowed: 0 to {}", patch, s.patches.size() - 1));
      })
      .build();
}

Object sheetFileTable() {
  return Table<SheetFile>("Sheet file")
      .path("path", &SheetFile::path, "garment file with patches and seams, relative to the case's folder")
      .required()
      .build();
}

}  // namespace gambeson::schema::sheet
