/// Detail of write.hpp: the words of a report: causes, checks, assumptions.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/ticks.hpp"
#include "cases/cloth/fabric_input.hpp"
#include "cases/cloth/make_cloth.hpp"
#include "cases/wear/case/factors.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "cases/wear/recording/zone_ledger.hpp"
#include "cases/wear/results/joint_words.hpp"
#include "cases/wear/results/write.hpp"
#include "core/material/fabric_law.hpp"
#include "human/body/body_zones.hpp"
#include "human/files/units.hpp"

namespace gambeson {

std::string phaseWords(const Strides& strides, std::optional<double> phase) {
  return phase
             ? fmt::format("{} ({:.0f} % of the stride)", *phase < strides.foot_off ? "stance" : "swing", 100 * *phase)
             : "the lead-in from standing";
}

std::string causeOf(const JointMeasure& m, const std::optional<Strides>& strides) {
  if (m.prismatic || m.peak.value == 0) return "";
  const MovementWords words = movementWords(m.movement);
  const Push push = pushOf(m.peak.value, m.rate_at_peak);
  const bool still = push == Push::held;
  const char* who = still ? "" : push == Push::against ? " against the garment" : " with the garment's push";
  std::string text;
  if (strides && !m.side.empty())
    text = phaseWords(*strides, m.phase_at_peak) + fmt::format(", while the {} {}{}", m.part,
                                                               still                ? "is held"
                                                               : m.rate_at_peak > 0 ? words.rises
                                                                                    : words.falls,
                                                               who);
  else
    text = fmt::format("{} of the {}{}",
                       still                ? "standstill"
                       : m.rate_at_peak > 0 ? words.to_above
                                            : words.to_below,
                       m.part, who);
  const double degrees = m.position_at_peak / rad_per_deg;
  return text + fmt::format(", at {:.0f} degrees of {}", std::abs(degrees), degrees >= 0 ? words.above : words.below);
}

std::string signRule() {
  return "Added torque is what the wearer's muscles must give on top because of the garment: the opposite of the "
         "torque of the cloth's "
         "contact forces about the joint axis. Positive: the wearer must push towards positive joint values (flexion, "
         "adduction, internal "
         "rotation).";
}

namespace {

/// Whether the law of all garments is a table.
bool allTables(const Case& c) {
  return std::all_of(c.garments.begin(), c.garments.end(),
                     [&](const GarmentCase& g) { return fabricOf(c, g).energy_source.has_value(); });
}

}  // namespace

std::string stretchMeaning(const Case& c, std::span<const Stretch> measured) {
  std::vector<std::string> stated;
  for (const Stretch& s : measured) {
    if (!s.stated) continue;
    const std::string text = fmt::format("{:g} %{}{}", 100 * s.limit, s.along.empty() ? "" : " along the " + s.along,
                                         s.garment.empty() ? "" : " of " + s.garment);
    if (std::find(stated.begin(), stated.end(), text) == stated.end()) stated.push_back(text);
  }
  double most = 0;
  for (const Stretch& s : measured) most = std::max(most, s.largest);
  // The strain is no longer the elongation: (1 + e)^2 = 1 + 2 E.
  const std::string large =
      most > 0.1 ? fmt::format(", {:.0f} % are {:.0f} cm", 100 * most, 100 * (std::sqrt(1 + 2 * most) - 1)) : "";
  const std::string law =
      allTables(c) ? "a table, beyond whose range stress is a guess"
                   : fmt::format(
                         "a straight line, which its source takes for strains below {} % (Zheng 2013, eq. 2.13); "
                         "beyond that stress is extrapolated, and a real fabric may be stiffer",
                         100 * kStrainOfLaw);
  // Two limits that readers take for one: what the fabric stands, and how far its law is known.
  const std::string limits =
      stated.empty()
          ? fmt::format(
                "Nobody states how far this fabric may be stretched (limit_strain of a fabric, elongation of a "
                "card), so that the limit that holds is how far its law is known: the law is {}.",
                law)
          : fmt::format(
                "The limit that holds is what the fabric stands by its card or case, less than {}: checks and "
                "lights go by it, and beyond it the fabric may not come back, or tear. It is along the threads; "
                "pictures show "
                "the largest stretch in any direction, which is more where cloth gives way on the bias. How far its "
                "law is known "
                "is another thing, which fails no check: the law is {}.",
                fmt::join(stated, ", "), law);
  return fmt::format(
      "Stretch is the Green-Lagrange strain: 1 % is 1 cm on 1 m{}. {}{} A largest value far above what 99 % of the "
      "cloth stays below is that of single spots, at corners and seams.",
      large, limits, c.strain_limit ? " The computation holds the strain of weft and warp to a limit of its own." : "");
}

namespace {

/// "Here the cloth lost 0.31 J more than these works explain, which are 0.063 J in all: as much as lifts it by 24 cm."
std::string energyHere(const EnergyMeasure& e) {
  const double drift = e.drift();
  if (!(e.lift > 0) || !std::isfinite(drift)) return "";
  const double lift_mm = 1e3 * EnergyMeasure::lift_m * std::abs(drift) / e.lift;
  return fmt::format(
      "; here the cloth {} {} J more than these explain, which are {} J in all{}: as much as lifts it by {} mm",
      drift < 0 ? "lost" : "gained", formatNumber(std::abs(drift), 2), formatNumber(e.absolute, 2),
      e.absolute < e.lift ? fmt::format(", and to lift it by 1 mm takes {} J", formatNumber(e.lift, 2)) : "",
      formatNumber(lift_mm, 2));
}

/// Over a sensor's width. A disc of 1 cm^2 that is pressed on a muscle begins to hurt at some hundred kPa (pressure
/// algometry, Fischer 1987, Pain 30(1), 115-126); that it is 200 is a choice of ours. Before that flesh gives way,
/// which the bodies here do not, and the wearer ends the movement.
constexpr double kFleshBears_Pa = 2e5;

}  // namespace

std::vector<AuditCheck> auditOf(const Measured& m) {
  std::vector<AuditCheck> checks{
      {"Momentum", m.steps.momentum_error, 1e-9, "",
       "in every step: the cloth's change of momentum against gravity, drag, supports and what the body's own ledger "
       "received; the largest"},
      {"Energy", 100 * m.energy.relative(), m.energy.integrator ? 1e-4 : 5., "%",
       (m.energy.integrator
            ? "over the motion: the change of the total energy against the works of contact, drag and supports and "
              "what "
              "the integrator itself made or took, of the sum of the absolute works, or of what lifts the cloth by 1 "
              "mm "
              "where that is more"
            : "over the motion: the change of the total energy against the works of contact, drag and supports, "
              "of the sum of the absolute works, or of what lifts the cloth by 1 mm where that is more") +
           energyHere(m.energy)},
      {"Penetration", 1e3 * m.steps.deepest_m, 0.2, "mm",
       "the deepest point of the cloth's samples inside the body, over the motion"},
      {"Contact solver",
       m.steps.steps > 0 ? 100.0 * static_cast<double>(m.steps.unconverged) / static_cast<double>(m.steps.steps) : 0, 1,
       "%",
       "share of the steps whose contacts were not solved to the tolerance of the case, or to a millionth of the "
       "largest impulse where cloth is jammed"}};
  if (m.energy.integrator)
    checks.push_back({"Integrator", 100 * m.energy.made(), 5, "%",
                      "energy that the integrator itself made over the motion, of the same works"});
  double pinched = 0;
  for (const CollisionWindow& w : m.steps.collisions) pinched += static_cast<double>(w.pinched);
  checks.push_back({"Intersections",
                    m.steps.collisions.empty() ? 0 : static_cast<double>(m.steps.collisions.back().intersections), 0,
                    "", "places where cloth passes through cloth or a mesh at the end"});
  double way = 0;
  for (const CollisionWindow& w : m.steps.collisions) way = std::max(way, w.way_cells);
  checks.push_back({"Movement", way, 0.5, "cells", "the farthest that a sample of the cloth goes in a step"});
  checks.push_back({"Pinched", pinched, 0, "", "samples between two obstacles whose impacts had to be let pass"});
  const auto hardest = std::max_element(m.comfort.begin(), m.comfort.end(),
                                        [](const auto& a, const auto& b) { return a.peak_Pa < b.peak_Pa; });
  if (hardest != m.comfort.end())
    checks.push_back(
        {"Pressure on flesh", 1e-3 * hardest->peak_Pa, 1e-3 * kFleshBears_Pa, "kPa",
         fmt::format("the largest pressure over the width of a sensor, anywhere on the body and at any time "
                     "that counts, beside what begins to hurt; here on the {} at {:.2f} s",
                     spokenZone(hardest->zone), hardest->peak_time_s)});
  if (m.limited)
    checks.push_back(
        {"Strain limit",
         m.steps.limited > 0 ? 100.0 * static_cast<double>(m.steps.unlimited) / static_cast<double>(m.steps.limited)
                             : 0,
         1, "%",
         "share of the steps after settling at whose end a thread missed its strain by more than the tolerance of the "
         "case"});
  if (m.law_range.points > 0)
    checks.push_back({"Law range",
                      100.0 * static_cast<double>(m.law_range.beyond) / static_cast<double>(m.law_range.points), 0, "%",
                      "share of the points of the cloth that are strained beyond the range of its law, in the frame "
                      "where most are"});
  if (m.surface_depth)
    checks.push_back(
        {"Penetration between samples", 1e3 * m.surface_depth->deepest_m, 0.2, "mm",
         "the deepest point of the cloth's surface, evaluated four times finer than the samples, at every frame"});
  if (m.seam_gap)
    checks.push_back({"Seams", 100 * m.seam_gap->cells, 1, "%",
                      fmt::format("the widest gap between both sides of a sewn seam at every frame, of the side of a "
                                  "cell; here {:.3g} mm at a height of {:.2f} m",
                                  1e3 * m.seam_gap->gap_m, m.seam_gap->at_m.z)});
  for (const FallMeasure& f : m.falls)
    checks.push_back(
        {f.garment.empty() ? "Slipping" : "Slipping, " + f.garment, 1e3 * f.largest_m, 50, "mm",
         "mean fall of the garment in the motion, against the part of the body that it goes with best, and "
         "by what it came down further than 100 mm while it was put on; the largest"});
  for (const GarmentOrderMeasure& l : m.garment_order)
    checks.push_back({"Layer order, " + l.higher + " over " + l.lower, 100 * l.largest, 25, "%",
                      "the share of the upper garment that lies inside of the lower one, of what of it has that one "
                      "within 30 mm; the largest over the motion"});
  for (const SupportMeasure& s : m.supports)
    if (s.springs)
      checks.push_back({"Sinking, " + s.name, 1e3 * s.largest_drop_m, 20, "mm",
                        "mean sinking of the supported edge against the body, the largest"});
  if (const JointMeasure* top = m.highest(); top && top->second_stride && top->second_stride->samples > 0) {
    const std::string joint = top->part + " " + top->movement + (top->side.empty() ? "" : ", " + top->side);
    checks.push_back({"Repeatability, shape", 1 - top->second_stride->correlation, 0.05, "",
                      "1 minus the correlation of the second stride's added torque with the first's (" + joint + ")"});
    checks.push_back({"Repeatability, size", 100 * top->second_stride->relative, 10, "%",
                      "RMS difference of the second stride from the first, of the first's RMS (" + joint + ")"});
  }
  return checks;
}

namespace {

/// How a fabric bends; `of`: "" where there is only one.
void sayFabric(const std::string& of, const FabricCase& f, std::vector<std::string>& list) {
  const auto say = [&](const std::string& text) { list.push_back(of + text); };
  say(f.energy_source ? schema::lawInWords(*f.energy_source) : schema::bendingInWords(f.law));
  say(f.rest_curvature_of_shape
          ? "The fabric rests in its sewn shape: bending starts from that curvature."
          : "The fabric is flat at rest (Zheng 2013): bending it around the body already costs moment.");
  if (f.energy_source) return;
  const GivenRigidities* given = givenRigidities(f.law);
  say(given && given->twist_Nm > 0 ? fmt::format("Twist stiffness {} N m.", formatNumber(given->twist_Nm))
                                   : "The fabric has no stiffness against twist (Zheng 2013).");
}

}  // namespace

std::vector<std::string> assumptionsOf(const Scenario& s, const Measured& m) {
  const Case c = withFactors(s.definition);
  std::vector<std::string> list;
  const auto say = [&](std::string text) { list.push_back(std::move(text)); };
  if (const std::string factors = factorsText(s.definition.factors); !factors.empty())
    say("Factors on what the case says: " + factors + ". What stands below has them in it.");
  if (s.human) {
    if (c.human->character)
      say(fmt::format(
          "The body is the skin of {}: its bones' weights blend the motions of the links linearly. Limits of "
          "joints and shares of mass are those of {}; its mass is {:.1f} kg. Flesh does not give way.",
          c.human->character->file.filename().string(), c.human->character->like, s.human->mass_kg));
    else if (c.human->scan)
      say(fmt::format(
          "The body is the scan {}: its joints were found from landmarks of its surface, and weights by distance along "
          "the skin blend the motions of the links linearly. Limits of joints and shares of mass are those of {}; its "
          "mass is {:.1f} kg. Flesh does not give way.",
          c.human->scan->file.filename().string(), c.human->scan->like, s.human->mass_kg));
    else if (s.hasSkin())
      say("The body is a closed skin drawn around a manikin of ellipsoids (sizes from ANSUR II (2012), masses from de "
          "Leva 1996, offsets of joints from Rajagopal et al. 2016), which bends with the joints. Flesh does not give "
          "way.");
    else if (!c.human->manikin.empty() || c.human->measures)
      say("The body is a manikin of rigid ellipsoids: sizes from ANSUR II (2012), masses from de Leva 1996, offsets of "
          "joints from Rajagopal et al. "
          "2016. Flesh does not give way, and the thighs are flattened at the sides so that the legs clear each "
          "other.");
    else
      say("The body is rigid: flesh does not give way.");
    if (s.hasSkin())
      say("A joint's torque is the generalised force of the contact on the skin: the sum over its vertices of force "
          "times how the vertex moves with the joint. torques.csv also holds the sum over segments (NAME_segments_Nm: "
          "each vertex belongs to the link of its largest weight), and the same with the segments' border moved by 2 "
          "cm "
          "towards the trunk (NAME_proximal_Nm) and away from it (NAME_distal_Nm).");
    if (const BodyZones zones(*s.human); std::ranges::count(zones.names(), "waist"))
      say("Parts of the body: a shoulder is the trunk above the level of the armpits on that side, and the top of the "
          "upper arm down to the armpit; the waist is the lower 40 % of the trunk from the lumbar joint up to the "
          "shoulder joints, the chest what lies between; hips are the pelvis.");
    say(kindOf(*c.human).assumption(*s.motion));
    if (s.feet && m.playedToTheEnd(s)) {
      std::string feet = feetText(*s.feet);
      feet[0] = 'T';
      say(feet + ".");
    }
    say(c.analysis.counting == Counting::all_distal
            ? "A joint's torque counts the contact on every segment distal of it."
            : "A joint's torque counts the contact on the segment next to it on the distal side (Man 2006).");
    say(
        fmt::format("Torques are impulses over windows of {} ms, not filtered; the garment's weight and inertia enter "
                    "only through its contact.",
                    formatNumber(1e3 * c.output.window_s)));
    if (const std::string natural = naturalMeaning(c.analysis.task); !natural.empty()) say(natural);
  }
  if (const auto& strides = m.strides; strides && m.played == Measured::Played::strides)
    say(fmt::format(
        "Peaks and root mean squares of torques count from the foot strike at {} s on; the lead-in before it is "
        "only drawn.",
        formatNumber(strides->start_s)));
  if (!c.contact.self) say("Cloth does not touch cloth in this case: folds and garments may cross each other.");
  say("Cloth rests on bodies with its samples, and on cloth with samples and sharp edges; what would pass through a "
      "mesh or through cloth within a step is found for its triangles and edges.");
  const bool remembers = std::any_of(c.garments.begin(), c.garments.end(),
                                     [&](const GarmentCase& g) { return lawUse(fabricOf(c, g)).remembers(); });
  say(allTables(c) ? "The fabric is elastic and does not remember: no hysteresis, no plastic strain."
      : remembers
          ? "Stretched fabric is elastic; what bent fabric remembers is said with its law. "
            "Membrane: linear and orthotropic (Zheng 2013, eq. 2.13)."
          : "The fabric is elastic and does not remember: no hysteresis, no plastic strain. Membrane: linear and "
            "orthotropic (Zheng 2013, eq. 2.13).");
  for (const GarmentCase& g : c.garments)
    if (const std::string own = ownLawsInWords(g.cloth); !own.empty())
      say((c.garments.size() > 1 ? g.name + ": " : "") + own);
  if (c.strain_limit) say(limitInWords(*c.strain_limit, "the window"));
  std::vector<FabricCase> said;
  for (const GarmentCase& g : c.garments) {
    const FabricCase& f = fabricOf(c, g);
    if (std::find(said.begin(), said.end(), f) != said.end()) continue;
    said.push_back(f);
    const bool one = std::all_of(c.garments.begin(), c.garments.end(),
                                 [&](const GarmentCase& other) { return fabricOf(c, other) == f; });
    sayFabric(one ? "" : fmt::format("Fabric of {}: ", g.name), f, list);
  }
  for (const GarmentCase& g : c.garments)
    for (std::size_t k = 0; k < g.other_fabrics.size(); ++k)
      sayFabric(fmt::format("Fabric {} of the material field{}: ", k + 1, g.name.empty() ? "" : " of " + g.name),
                g.other_fabrics[k], list);
  for (const GarmentMeasure& l : garmentMeasuresOf(s))
    if (l.varies())
      say(
          fmt::format("{} varies from {} to {} mm, {} mm in the mean over its area: mass, membrane and the "
                      "distance kept in contact follow it in proportion, bending with its cube.",
                      l.name.empty() ? "The cloth's thickness" : fmt::format("The thickness of {}", l.name),
                      formatNumber(1e3 * l.least_thickness_m), formatNumber(1e3 * l.largest_thickness_m),
                      formatNumber(1e3 * l.thickness_m)));
  if (c.air.drag_kg_per_m2s > 0)
    say(fmt::format("Air drag is linear, {} kg/(m² s) times the velocity relative to the air, which {}.",
                    formatNumber(c.air.drag_kg_per_m2s),
                    c.air.with_pelvis ? "moves with the pelvis's mean velocity" : "is that of the case"));
  say(fmt::format("Contact begins at {} and is restored with a relaxation time of {} ms; {}{}.",
                  c.contact.layer_m ? fmt::format("a layer of {} mm", formatNumber(1e3 * *c.contact.layer_m))
                                    : "the thickness of the cloth",
                  formatNumber(1e3 * c.contact.relaxation_s), inWords(c.contact.friction),
                  c.contact.friction_cloth ? "; of cloth with cloth " + inWords(*c.contact.friction_cloth) : ""));
  if (const std::string method = inWords(c.contact); !method.empty()) say(method);
  for (const ObstacleCase& o : c.obstacles)
    if (o.friction) say(fmt::format("Friction with {}: {}.", o.name, inWords(*o.friction)));
  for (const GarmentCase& g : c.garments)
    if (g.friction) say(fmt::format("Friction of {} with bodies: {}.", g.name, inWords(*g.friction)));
  for (const SupportGroup& g : s.supports)
    say(g.cord.empty() ? "Support: " + g.name + ". Its reaction is reported apart and is part of no joint torque."
                       : "Support: " + g.name + ". It pulls the cloth together, and what it presses on bears that.");
  return list;
}

}  // namespace gambeson
