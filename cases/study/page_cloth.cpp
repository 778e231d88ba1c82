/// Detail of page_parts.hpp: the garment on its wearer: pressure, garments, fit, stress.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/report/html.hpp"
#include "analysis/ticks.hpp"
#include "cases/cloth/make_cloth.hpp"
#include "cases/study/page_parts.hpp"
#include "cases/wear/case/human.hpp"
#include "cases/wear/recording/zone_ledger.hpp"
#include "cases/wear/results/write.hpp"

namespace gambeson::study {

using html::element;
using html::escape;
using html::prose;

namespace {

/// The table of the segments' shares of the contact force.
std::string segmentsOf(const Study& s, const Comparison& c) {
  std::vector<std::string> names, columns{"variant"};
  for (const RunNumbers& r : c.runs)
    for (const ContactNumbers& b : r.contact)
      if (b.share > 0.005 && std::find(names.begin(), names.end(), b.segment) == names.end())
        names.push_back(b.segment);
  if (names.empty()) return "";
  for (const std::string& n : names) {
    columns.push_back(n + " [%]");
    std::replace(columns.back().begin(), columns.back().end(), '_', ' ');
  }
  std::vector<std::vector<Html>> rows;
  for (const VariantGroup& g : c.groups)
    for (const std::size_t i : g.members) {
      if (!c.runs[i].good) continue;
      rows.push_back({escape(s.variants[i].label)});
      for (const std::string& n : names) {
        double share = 0;
        for (const ContactNumbers& b : c.runs[i].contact)
          if (b.segment == n) share = b.share;
        rows.back().emplace_back(100 * share, 2);
      }
    }
  return folded(
      "Shares of the segments of the body",
      charts(htmlTable("Contact by segments", columns, rows,
                       "Shares of the mean contact force of the links of the skeleton, with belt and edges on "
                       "springs: what these press, which the parts of the body above leave out, is mostly the "
                       "pelvis\u2019s. Segments with less than 0.5 % everywhere are left out.")));
}

/// "Pressure", with the width that it is a mean over.
std::string pressureOf(const Comparison& c) {
  return c.input.sensor_m > 0 ? fmt::format("Pressure, the mean over {:g} mm", 1e3 * c.input.sensor_m) : "Pressure";
}

/// " times the 30 minutes that the case says it is worn"; nothing where variants differ in that.
std::string wornFor(const Study& s) {
  std::set<double> minutes;
  for (const Variant& v : s.variants)
    if (const auto* c = std::get_if<Case>(&v.definition)) minutes.insert(c->comfort.wear_s / 60);
  return minutes.size() == 1
             ? fmt::format(" times the {:g} minutes that the garment is taken to be worn", *minutes.begin())
             : " times how long the garment is taken to be worn";
}

}  // namespace

std::string forcesOf(const Study& s, const Comparison& c) {
  std::vector<std::vector<Html>> split, shares, comfort;
  std::set<std::string> zones;
  for (const VariantGroup& g : c.groups)
    for (const std::size_t i : g.members)
      for (const ZoneNumbers& z : c.runs[i].zones)
        if (z.normal_N > 0.005 * c.runs[i].pressing_N()) zones.insert(z.zone);
  for (const VariantGroup& g : c.groups)
    for (const std::size_t i : g.members) {
      const RunNumbers& r = c.runs[i];
      if (!r.good) continue;
      const std::string label = escape(s.variants[i].label);
      if (const ComfortNumbers* k = r.leastComfortable())
        comfort.push_back(
            {label, lightOf(lightNamed(k->light), r.trust()), escape(spokenZone(k->zone)), Html(1e-3 * k->mean_Pa),
             Html(1e-3 * k->amber_Pa), Html(1e-3 * k->red_Pa), Html(1e-3 * k->peak_Pa),
             Html(html::seconds(k->peak_time_s) + (k->peak_during.empty() ? "" : ", " + escape(k->peak_during))),
             Html(1e-3 * k->peak_limit_Pa), Html(k->dose_kPa_min)});
      const double all = r.pressing_N();
      if (!zones.empty()) {
        std::vector<Html> row{label, Html(all)};
        for (const std::string& name : zones) {
          double part = 0;
          for (const ZoneNumbers& z : r.zones)
            if (z.zone == name) part = z.normal_N;
          row.emplace_back(all > 0 ? 100 * part / all : 0, 2);
        }
        shares.push_back(std::move(row));
      }
      if (const JointNumbers* j = r.joint(g.joint()))
        split.push_back(
            {label, escape(j->label), Html(j->normal_N), Html(j->friction_N), Html(std::abs(j->peak_Nm)),
             Html(j->friction_Nm && j->peak_Nm != 0 ? 100 * *j->friction_Nm / j->peak_Nm : std::nan(""), 2)});
    }
  std::vector<std::string> columns{"variant", "pressing, sum [N]"};
  for (const std::string& zone : zones) columns.push_back(spokenZone(zone) + " [%]");
  std::string out;
  if (!comfort.empty())
    out += htmlTable(
        "Comfort: the part of the body that is furthest from comfortable",
        {"variant", "verdict", "part", "mean [kPa]", "comfortable [kPa]", "limit [kPa]", "peak [kPa]", "peak at",
         "limit of peaks [kPa]", "dose [kPa min]"},
        comfort,
        pressureOf(c) +
            ", where it is largest, against the limits of the case: red where the mean over time or the peak is above "
            "its limit, amber where the mean is above what is comfortable. Another variant may press most on another "
            "part. Dose: the mean" +
            wornFor(s) + ". Each variant\u2019s own report has all parts, and pictures.");
  if (!shares.empty())
    out += htmlTable("Which parts of the body bear the garment", columns, shares,
                     "Shares of the mean force that presses, both sides together, without belt and edges on springs. "
                     "Parts with less than 0.5 % everywhere are left out.");
  if (!split.empty())
    out += htmlTable(
        "Pressing and friction at the joint that decides",
        {"variant", "joint", "pressing, mean [N]", "friction, mean [N]", "peak torque [Nm]", "of it by friction [%]"},
        split,
        "Forces: sums of magnitudes on the segments that count for the joint. Torque: what the tangential "
        "parts of the contact forces have in it when it peaks; a negative share is of the other sense.");
  return out.empty() ? "" : element("div", out, " class=\"charts single\"") + segmentsOf(s, c);
}

namespace {

/// How the garments of a variant are computed; empty where they are none that are worn.
std::string kindOfCloth(const Variant& v) {
  const auto* c = std::get_if<Case>(&v.definition);
  if (!c) return "";
  std::vector<std::string> kinds;
  for (const GarmentCase& g : c->garments) {
    const std::string own = ownLawsInWords(g.cloth), words = inWords(g.cloth) + (own.empty() ? "" : " " + own);
    if (kinds.empty() || kinds.back() != words) kinds.push_back(words);
  }
  std::string all;
  for (const std::string& k : kinds) all += (all.empty() ? "" : " ") + k;
  return all;
}

}  // namespace

std::string kindsOf(const Study& s, const Comparison& c) {
  std::vector<std::pair<std::string, std::string>> kinds;  // of each level its words, once
  std::set<std::string> different;
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    const std::string words = kindOfCloth(s.variants[i]), name = memberName(s, c, i);
    if (words.empty() || !s.variants[i].grid) continue;
    different.insert(words);
    if (std::find(kinds.begin(), kinds.end(), std::pair(name, words)) == kinds.end()) kinds.emplace_back(name, words);
  }
  if (different.size() < 2) return "";
  std::vector<std::vector<Html>> rows;
  for (const auto& [name, words] : kinds) rows.push_back({Html(escape(name)), Html(prose(words))});
  return charts(htmlTable(
      "What the cloth is made of", {"variant", "how it is computed"}, rows,
      "The fabric is the same: each row says what that kind of cloth puts in place of it, or leaves out. Pull "
      "and pressure are known of all kinds; the pull of springs is what they carry through a cell."));
}

std::string thicknessPage(const Study& s, const Comparison& c) {
  std::vector<std::string> names;
  for (const RunNumbers& r : c.runs)
    for (const GarmentNumbers& l : r.garments)
      if (std::find(names.begin(), names.end(), l.name) == names.end()) names.push_back(l.name);
  if (names.empty()) return "";
  std::vector<std::string> columns{"variant"};
  for (const std::string& n : names) columns.push_back(n.empty() ? "the garment" : n);
  columns.insert(columns.end(), {"all [kg]", "cloth [m\u00b2]", "points of the mesh"});
  // What is the same in all motions is told once.
  std::vector<std::pair<std::string, std::vector<std::vector<Html>>>> levels;
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    const RunNumbers& r = c.runs[i];
    if (!r.good || !s.variants[i].grid || r.garments.empty()) continue;
    std::vector<Html> row{escape(s.variants[i].label)};
    double area = 0;
    for (const std::string& n : names) {
      std::string cell = "\u2013";
      for (const GarmentNumbers& l : r.garments)
        if (l.name == n)
          cell = escape(formatNumber(1e3 * l.thickness_m) + " mm, " + formatNumber(l.mass_kg) + " kg"),
          area += l.area_m2;
      row.push_back(Html::aligned(cell));
    }
    row.insert(row.end(), {Html(r.mass_kg()), Html(area), Html(r.control_points)});
    const std::string name = memberName(s, c, i);
    auto at = std::find_if(levels.begin(), levels.end(), [&](const auto& l) { return l.first == name; });
    if (at == levels.end()) at = levels.insert(at, {name, {}});
    at->second.push_back(std::move(row));
  }
  std::vector<std::vector<Html>> rows;
  for (auto& [name, all] : levels) {
    const bool same = std::all_of(all.begin(), all.end(), [&](const auto& row) {
      return std::equal(row.begin() + 1, row.end(), all[0].begin() + 1,
                        [](const Html& a, const Html& b) { return a.html == b.html; });
    });
    if (same) all.resize(1), all[0][0] = Html(escape(name));
    rows.insert(rows.end(), all.begin(), all.end());
  }
  return charts(htmlTable("Thickness and mass of each garment", columns, rows, ""));
}

namespace {

/// "15 (weft)"
Html limitOf(const Stretch* s) {
  if (!s) return Html::aligned("\u2013");
  const std::string of = !s->stated ? "its law" : s->along;
  return Html::aligned(escape(fmt::format("{:g}{}", 100 * s->limit, of.empty() ? "" : " (" + of + ")")));
}

}  // namespace

std::string clothOf(const Study& s, const Comparison& c) {
  std::vector<std::vector<Html>> fit;
  std::string stretch;
  for (const VariantGroup& g : c.groups)
    for (const std::size_t i : g.members) {
      const RunNumbers& r = c.runs[i];
      if (!r.good || r.garments.empty()) continue;
      // As the verdict has it: that which goes furthest beyond its limit.
      const Stretch* worst = worstOf(r.stretch);
      const StressNumbers* top = nullptr;
      double most = std::nan("");  // of all patches, as the pictures have it
      for (const StressNumbers& n : r.stress) {
        if (!top || n.p99_N_per_m > top->p99_N_per_m) top = &n;
        most = std::fmax(most, n.max_N_per_m);
      }
      std::string region = top ? top->region : "\u2013", wearer = "\u2013";
      std::replace(region.begin(), region.end(), '_', ' ');
      const auto* k = std::get_if<Case>(&s.variants[i].definition);
      if (k && stretch.empty()) stretch = stretchMeaning(*k, r.stretch);
      if (k && k->human)
        wearer = wearerName(*k->human);
      fit.push_back({escape(s.variants[i].label), escape(wearer), Html(100 * (worst ? worst->most : r.p99_strain())),
                     Html(100 * (worst ? worst->largest : r.largest_strain)), limitOf(worst), Html(r.sinking_mm(), 2),
                     Html(r.pressing_N()), escape(region), Html(top ? top->p50_N_per_m : std::nan("")),
                     Html(top ? top->p99_N_per_m : std::nan("")), Html(most)});
    }
  if (fit.empty()) return "";
  return charts(htmlTable(
      "Fit, and what the fabric carries",
      {"variant", "wearer", "stretch, 99 % below [%]", "largest [%]", "meant for less than [%]",
       "edge on springs sinks [mm]", "presses [N]", "patch that is pulled most", "half of it below [N/m]",
       "99 % of it below [N/m]", "single spots of any patch, up to [N/m]"},
      fit,
      "Fit: how far the garment stretches and slides on its wearer, and how hard it presses in the mean; 99 % is of "
      "the patch that stretches most, in the direction named. Pull: the stress in the fabric, per metre of width, over "
      "the area of the patch "
      "of which 99 % stays below the most, and over the motion; single spots, at corners and seams, of any patch. " +
          stretch));
}

}  // namespace gambeson::study
