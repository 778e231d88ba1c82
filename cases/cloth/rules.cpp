#include "cases/cloth/rules.hpp"

#include "core/cloth/degenerated/degenerated_shell.hpp"
#include "core/cloth/springs/spring_net.hpp"

namespace gambeson::schema {

void checkBending(const Entry& entry, const ClothModel& model) {
  const auto refuse = [&](const char* key, const char* reason) {
    if (entry.node.find(key)) entry.failAt(key, reason);
  };
  if (model.kind != ClothKind::triangles) refuse("bending_elements", "is for \"model\": \"triangles\"");
  if (model.kind != ClothKind::triangles || model.bending != BendingElements::springs)
    refuse("bending_spring", "is for triangles with \"bending_elements\": \"springs\"");
}

void checkNodes(const Entry& entry, const ClothModel& model, const Fabric& fabric) {
  if (fabric.energy && model.kind != ClothKind::nurbs)
    entry.failAt(
        "model",
        R"(does not carry a fabric whose law is a table, a cell of yarns or curves; allowed with it: "nurbs")");
  if (fabric.energy && model.rule == CellRule::assumed)
    entry.failAt(
        "cell_rule",
        R"(does not go with a fabric whose law is a table, a cell of yarns or curves; allowed with it: "automatic", "full")");
  if (model.kind != ClothKind::springs && entry.node.find("springs"))
    entry.failAt("springs", "is for \"model\": \"springs\"");
  if (model.kind != ClothKind::shell && entry.node.find("shell")) entry.failAt("shell", "is for \"model\": \"shell\"");
  const std::string why = model.kind == ClothKind::springs ? whatSpringsLack(fabric)
                          : model.kind == ClothKind::shell ? whatShellLacks(fabric)
                                                           : "";
  if (!why.empty()) entry.failAt("model", why + R"(; allowed with it: "nurbs", "triangles")");
}

void refuseCell(const Entry& entry, const FabricCase& fabric) {
  if (!fabric.energy_source || !fabric.energy_source->isCell()) return;
  const Entry law = entry.member(*entry.node.find("law"));
  law.failAt(
      law.node.find("cell") ? "cell" : "yarns",
      "is solved in cases of kind static alone; allowed here: \"table\", which gambeson homogenise makes of the cell");
}

}  // namespace gambeson::schema
