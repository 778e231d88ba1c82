#include "cases/wear/case/device_keys.hpp"

#include <fmt/format.h>

#include "cases/input/wrong_entry.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "cases/wear/case/supports/kind.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

class Refusals {
 public:
  Refusals(const Case& c, DeviceKind device) : case_(c), device_(device) {}

  void look() const {
    lookAtFabric("fabric", case_.fabric);
    for (std::size_t g = 0; g < case_.garments.size(); ++g)
      lookAtGarment(fmt::format("garments[{}]", g), case_.garments[g]);
    if (case_.human && case_.human->feet)
      refuse("human.feet", "feet that are left out are not carried by", "a human with feet");
    for (std::size_t k = 0; k < case_.obstacles.size(); ++k)
      if (const auto& law = case_.obstacles[k].friction) lookAtFriction(fmt::format("obstacles[{}].friction", k), *law);
    for (std::size_t k = 0; k < case_.supports.size(); ++k)
      lookAtSupport(fmt::format("supports[{}]", k), case_.supports[k]);
    lookAtFriction("contact.friction", case_.contact.friction);
    if (case_.contact.friction_cloth) lookAtFriction("contact.friction_cloth", *case_.contact.friction_cloth);
    if (case_.contact.method != ContactMethod::together)
      refuse("contact.method", "methods of contact of their own are not carried by", "\"together\"");
    if (case_.contact.newton)
      refuse("contact.newton", "Newton's method for contacts is not carried by", "false");
    if (case_.strain_limit) refuse("strain_limit", "limits of strain are not carried by", "none, and stiffer threads");
    if (case_.time.motion.scheme != MotionScheme::verlet)
      refuse("time.scheme", "other schemes than velocity Verlet are not carried by", "\"verlet\"");
    if (case_.time.audit) refuse("time.audit", "the account of the scheme's own energy is not kept by", "false");
  }

 private:
  [[noreturn]] void refuse(const std::string& key, const std::string& what, const std::string& allowed) const {
    sayInCase(case_.file, case_.overrides,
              InputError({"", 0, key}, fmt::format("{} --device {}; allowed with it: {}; without: --device cpu", what,
                                                   wordOf(device_), allowed)));
  }

  void lookAtFabric(const std::string& key, const Fabric& fabric) const {
    if (fabric.shear_friction != ShearFriction{})
      refuse(key + ".shear_loop", "friction in shear is not carried by", "a fabric without it");
    if (fabric.energy) refuse(key + ".law", "laws that are tables or curves are not carried by", "moduli and bending");
  }

  void lookAtFriction(const std::string& key, const FrictionLaw& law) const {
    if (!law.isCoulomb()) refuse(key, "friction that is more than one coefficient is not carried by", "a number");
  }

  void lookAtGarment(const std::string& key, const GarmentCase& g) const {
    if (g.cloth.kind == ClothKind::triangles) refuse(key + ".model", "triangles are not carried by", "\"nurbs\"");
    if (g.cloth.kind == ClothKind::springs) refuse(key + ".model", "springs are not carried by", "\"nurbs\"");
    if (g.cloth.kind == ClothKind::shell)
      refuse(key + ".model", "the degenerated shell is not carried by", "\"nurbs\"");
    if (kindOf(g).sewn) refuse(key + ".pattern", "panels with sewn seams are not carried by", "drafted garments");
    if (g.fabric) lookAtFabric(key + ".fabric", *g.fabric);
    for (std::size_t k = 0; k < g.other_fabrics.size(); ++k)
      lookAtFabric(fmt::format("{}.other_fabrics[{}]", key, k), g.other_fabrics[k]);
    if (g.friction) lookAtFriction(key + ".friction", *g.friction);
  }

  void lookAtSupport(const std::string& key, const SupportCase& support) const {
    std::visit(
        [&]<class S>(const S& s) {
          if constexpr (std::is_base_of_v<HeldSupport, S>)
            if (!s.drive.empty())
              refuse(fmt::format("{}.{}.drive", key, kindOf(support).word),
                     "points that are held and moved are not carried by", "supports that stand still");
          if constexpr (std::is_same_v<S, CordSupport>) refuse(key + ".cord", "cords are not carried by", "springs");
        },
        support);
  }

  const Case& case_;
  DeviceKind device_;
};

}  // namespace

void requireCarried(const Case& c, DeviceKind device) {
  if (device != DeviceKind::cpu) Refusals(c, device).look();
}

}  // namespace gambeson
