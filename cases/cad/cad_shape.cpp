#include "cases/cad/cad_shape.hpp"

namespace gambeson {
namespace {

void put(BytesOut& out, const KnotVector& k) {
  out.put(k.degree);
  out.put(k.knots);
}
void get(BytesIn& in, KnotVector& k) {
  in.get(k.degree);
  in.get(k.knots);
}

void put(BytesOut& out, const CadFace& f) {
  out.put(f.name);
  put(out, f.patch.u), put(out, f.patch.v);
  out.put(f.patch.points), out.put(f.patch.weights);
  out.put(f.loops.size());
  for (const TrimLoop& loop : f.loops) {
    out.put(loop.size());
    for (const NurbsCurve& c : loop) {
      put(out, c.knots);
      out.put(c.points), out.put(c.weights);
    }
  }
  out.put(f.plane), out.put(f.inside_out), out.put(f.area_m2), out.put(f.tolerance_m);
}

void get(BytesIn& in, CadFace& f) {
  in.get(f.name);
  get(in, f.patch.u), get(in, f.patch.v);
  in.get(f.patch.points), in.get(f.patch.weights);
  std::size_t loops = 0;
  in.get(loops);
  for (std::size_t l = 0; l < loops; ++l) {
    std::size_t curves = 0;
    in.get(curves);
    TrimLoop& loop = f.loops.emplace_back();
    for (std::size_t k = 0; k < curves; ++k) {
      NurbsCurve& c = loop.emplace_back();
      get(in, c.knots);
      in.get(c.points), in.get(c.weights);
    }
  }
  in.get(f.plane), in.get(f.inside_out), in.get(f.area_m2), in.get(f.tolerance_m);
}

}  // namespace

void put(BytesOut& out, const CadShape& s) {
  out.put(s.faces.size());
  for (const CadFace& f : s.faces) put(out, f);
  out.put(s.seams);
  out.put(s.unit), out.put(s.notes), out.put(s.dropped);
}

void get(BytesIn& in, CadShape& s) {
  std::size_t faces = 0;
  in.get(faces);
  for (std::size_t k = 0; k < faces; ++k) get(in, s.faces.emplace_back());
  in.get(s.seams);
  in.get(s.unit), in.get(s.notes), in.get(s.dropped);
}

}  // namespace gambeson
