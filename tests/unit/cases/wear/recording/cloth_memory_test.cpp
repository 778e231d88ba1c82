/// What tables and pictures are told of cloth that remembers.

#include "cases/wear/recording/cloth_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cases/wear/scene/scenario.hpp"
#include "core/material/laws/bending_laws.hpp"
#include "unit/cases/malformed.hpp"

namespace gambeson {
namespace {

/// A square of 0.4 m in 4 x 4 cells of two triangles, its fabric with a set.
std::string meshOf(const Folder& folder, const std::string& elements) {
  std::string obj;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i) obj += "v " + std::to_string(0.1 * i) + " " + std::to_string(0.1 * j) + " 0.01\n";
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const int a = 5 * j + i + 1;
      for (const auto& t : {std::array{a, a + 1, a + 6}, std::array{a, a + 6, a + 5}})
        obj += "f " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
    }
  folder.write("square.obj", obj);
  return R"({"name": "t", "garment": {"mesh_file": {"path": "square.obj"}, "bending_elements": ")" + elements +
         R"("}, "fabric": {"name": "f", "thickness": "1 mm", "density": "400 kg/m^3", "young": "1 MPa", "poisson": 0.2,
            "bending": {"law": "hysteresis", "rigidity": "1.4e-5 N m", "loop": {"axes": "isotropic",
            "initial_rigidity": "4.64e-5 N m", "c1": -2.15e-7, "set": 0.1, "fatigue": 0.1}}},
          "obstacles": [{"name": "ground", "plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}],
          "contact": {"friction": 0.3}, "time": {"duration": "0.1 s"}})";
}

// What one place of a mesh remembers is seen at the vertices about it and nowhere else.
TEST(ClothMemory, AMeshShowsItsSetWhereItIs) {
  const Folder folder;
  for (const char* elements : {"midedge", "hinge"}) {
    const auto s = buildScenario(readCase(folder.write("case.json", meshOf(folder, elements))));
    const Model& m = *s->model;
    const ClothMemoryView view(m);
    ASSERT_TRUE(view.any());
    const std::vector<HistoryPlace> places = m.cloth->historyPlaces();
    for (const HistoryPlace& h : {places.front(), places[places.size() / 2], places.back()}) {
      std::vector<double> history(m.cloth->historySize(), 0);
      history[h.first + 3 * kStops * h.stride] = 6;        // k11 of the set
      history[h.first + (3 * kStops + 3) * h.stride] = 1;  // no friction left
      const ClothMemory memory = view.at(history);
      const auto& t = m.surface.triangles[static_cast<std::size_t>(h.place.x / 2)];
      int seen = 0;
      for (int v = 0; v < m.surface.size(); ++v) {
        const bool about = memory.set_per_m[v] > 0;
        seen += about;
        EXPECT_EQ(memory.friction_left[v] < 1, about);
        if (about) {
          EXPECT_NE(std::find(t.begin(), t.end(), v), t.end()) << elements << " " << v;
        }
      }
      EXPECT_EQ(seen, std::string(elements) == "hinge" ? 2 : 3) << elements;
      const std::vector<double> row = view.row(history, 1);
      EXPECT_GT(row[0], 0);
      EXPECT_GE(row[1], 6. / 6) << "at least one of the six about a vertex";
      EXPECT_LT(row[2], 1);
      EXPECT_NEAR(row[3], 1 - row[1] / 6, 1e-12);
    }
  }
}

}  // namespace
}  // namespace gambeson
