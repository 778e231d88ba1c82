#include "cases/study/population_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gambeson::study {
namespace {

/// What keeps a run that came to its end from being worn; nothing where nothing does.
std::pair<Dressed, std::string> wornOf(const RunNumbers& r) {
  if (r.crossings_dressed.value_or(0) > 0)
    return {Dressed::crossed,
            fmt::format("cloth passes through cloth at {} places as it has been put on", *r.crossings_dressed)};
  for (const Stretch& s : r.stretch)
    if (s.stated && !s.holds())
      return {Dressed::stretched,
              fmt::format("the fabric is stretched by {:.3g} %{}, and stands {:.3g} %", 100 * s.largest,
                          s.along.empty() ? "" : " along its " + s.along, 100 * s.limit)};
  return {Dressed::yes, ""};
}

Fitting fittingOf(const Study& s, const RunNumbers& r, std::size_t variant) {
  Fitting f;
  f.variant = variant;
  if (s.population->sized()) f.size = s.variants[variant].levels[1];
  if (!r.good) {
    f.why = r.why;
    return f;
  }
  std::tie(f.dressed, f.why) = wornOf(r);
  f.judged_stretch = std::any_of(r.stretch.begin(), r.stretch.end(), [](const Stretch& k) { return k.stated; });
  const Trust trust = r.trust();
  for (const JointNumbers& j : r.joints) {
    if (j.prismatic) continue;
    for (std::size_t k = 0; k < kBurdened.size(); ++k) {
      if (!j.name.starts_with(kBurdened[k])) continue;
      JointBurden& b = f.burdens[k];
      b.looked = true;
      if (!j.applies()) continue;
      b.touched = true;
      if (j.part() && (!b.part || *j.part() > *b.part)) b.part = j.part(), b.label = j.label;
    }
    if (j.applies() && j.part() && (!f.worst_part || *j.part() > *f.worst_part))
      f.worst_part = j.part(), f.worst_joint = j.label;
  }
  // A joint that the garment does not reach is spared whatever the numbers of others stand on.
  for (JointBurden& b : f.burdens)
    if (b.looked && (b.touched || trust.spoiling == 0))
      b.light = b.touched ? shownLight(gambeson::lightOf(b.part, s.limits.green, s.limits.red), trust) : Light::green;
  if (const ComfortNumbers* k = r.leastComfortable()) {
    f.presses = k->zone;
    f.comfort = shownLight(lightNamed(k->light), trust);
    f.part_of_limit = k->part_of_limit();
  }
  return f;
}

/// Of two fittings the better: what goes on; then what burdens less.
bool better(const Fitting& a, const Fitting& b) {
  if (a.on() != b.on()) return a.on();
  return a.worst_part.value_or(0) < b.worst_part.value_or(0);
}

bool isGreen(Light l) { return l == Light::green || l == Light::doubtful; }

void count(Light light, PopulationShare& share) {
  if (light == Light::unknown)
    ++share.unknown;
  else if (isGreen(light))
    ++share.yes, share.doubtful += light == Light::doubtful;
  else
    ++share.no;
}

PopulationShare putOn(const PopulationAnswer& a) {
  PopulationShare share{"can put it on"};
  for (const WearerAnswer& w : a.wearers) ++(w.taken() && w.taken()->on() ? share.yes : share.no);
  return share;
}

/// Of all wearers: who cannot put it on has no light, and is not counted as spared.
void addShares(const PopulationAnswer& a, std::vector<PopulationShare>& shares) {
  for (std::size_t k = 0; k < kBurdened.size(); ++k) {
    PopulationShare share{fmt::format("{} stays green", kBurdened[k])};
    bool looked = false;
    share.touched = false;
    for (const WearerAnswer& w : a.wearers) {
      if (!w.taken() || !w.taken()->on()) {
        ++share.unknown;
        continue;
      }
      looked = looked || w.taken()->burdens[k].looked;
      share.touched = share.touched || w.taken()->burdens[k].touched;
      count(w.taken()->burdens[k].light, share);
    }
    if (looked) shares.push_back(share);
  }
  PopulationShare comfort{"is comfortable everywhere"};
  bool pressed = false;
  for (const WearerAnswer& w : a.wearers) {
    if (!w.taken() || !w.taken()->on()) {
      ++comfort.unknown;
      continue;
    }
    pressed = pressed || !w.taken()->presses.empty();
    count(w.taken()->presses.empty() ? Light::green : w.taken()->comfort, comfort);
  }
  if (pressed) shares.push_back(comfort);
}

/// Those it does not go on, then those of the largest part; of equal ones the first.
std::vector<std::size_t> burdenedMost(const PopulationAnswer& a) {
  constexpr std::size_t most = 3;
  std::vector<std::size_t> order;
  for (std::size_t w = 0; w < a.wearers.size(); ++w)
    if (a.wearers[w].taken() && a.wearers[w].taken()->dressed != Dressed::failed) order.push_back(w);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t x, std::size_t y) { return better(*a.wearers[y].taken(), *a.wearers[x].taken()); });
  order.resize(std::min(order.size(), most));
  return order;
}

std::string answerSentence(const PopulationAnswer& a) {
  const PopulationShare& on = a.shares[0];
  std::string green;  // that a joint is spared which the garment does not reach is no news
  for (const PopulationShare& s : a.shares)
    if (s.what.ends_with("stays green") && s.of() > 0 && s.touched)
      green += fmt::format("{}{} their {}s", green.empty() ? "" : ", ", s.yes, s.what.substr(0, s.what.find(' ')));
  return fmt::format("{} of {} wearers can put it on{}.", on.yes, on.of(),
                     green.empty() ? "" : "; of these keep green: " + green);
}

}  // namespace

PopulationAnswer answerOf(const Study& s, const std::vector<RunNumbers>& runs) {
  PopulationAnswer a;
  a.wearers.resize(s.population->wearers.size());
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    WearerAnswer& w = a.wearers[static_cast<std::size_t>(s.variants[i].levels[0])];
    w.fittings.push_back(fittingOf(s, runs[i], i));
    const auto last = static_cast<int>(w.fittings.size()) - 1;
    if (w.best < 0 || better(w.fittings.back(), *w.taken())) w.best = last;
    a.judged_stretch = a.judged_stretch || w.fittings.back().judged_stretch;
  }
  a.shares.push_back(putOn(a));
  addShares(a, a.shares);
  a.worst = burdenedMost(a);
  a.sentence = answerSentence(a);
  return a;
}

}  // namespace gambeson::study
