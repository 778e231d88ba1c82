#include "cases/cloth/strain_limit.hpp"

#include <fmt/format.h>

#include <map>

#include "analysis/ticks.hpp"
#include "cases/cloth/fields.hpp"
#include "cases/input/table.hpp"
#include "core/error.hpp"

namespace gambeson {

StrainLimit limitOf(const StrainLimitCase& c) {
  StrainLimit limit{c.mode, c.limit.value_or(0), c.tolerance, c.max_projections};
  limit.points = c.points;
  limit.method = c.method;
  if (c.stiffness_N_per_m) limit.stiffness_N_per_m = *c.stiffness_N_per_m;
  return limit;
}

StrainLimit wornLimit(const StrainLimitCase& c) {
  constexpr double kTensionAtTolerance_N_per_m = 100;
  StrainLimit limit = limitOf(c);
  if (c.method == LimitMethod::closest)
    throw InputError({"", 0, "strain_limit.method"},
                     "closest is for structures; cloth that is worn takes fast or provot");
  if (!c.stiffness_N_per_m) limit.stiffness_N_per_m = kTensionAtTolerance_N_per_m / c.tolerance;
  return limit;
}

std::string limitInWords(const StrainLimitCase& c, const std::string& mean) {
  static const std::map<LimitPoints, const char*> words{{LimitPoints::vertices, "the vertices of the knot mesh"},
                                                        {LimitPoints::threads, "points of each thread's own"},
                                                        {LimitPoints::gauss, "four Gauss points of each cell"},
                                                        {LimitPoints::centres, "the middle of each cell"}};
  const std::string held =
      c.mode == LimitMode::equality
          ? "Weft and warp keep their length"
          : fmt::format("Weft and warp are kept from stretching beyond a strain of {}", formatNumber(*c.limit));
  return fmt::format(
      "{} by projection at {} ({}); stress includes what that takes, as a mean over {}.", held, words.at(c.points),
      c.method == LimitMethod::provot ? "one after the other, Provot 1995" : "Zheng 2013, chapter 5", mean);
}

namespace schema {

Object strainLimitTable() {
  using S = StrainLimitCase;
  return Table<S>("Strain limit")
      .choice(
          "mode", &S::mode,
          std::vector<std::pair<std::string, LimitMode>>{{"upper_limit", LimitMode::upper_limit},
                                                         {"equality", LimitMode::equality}},
          "upper_limit: threads may slacken, and hold where they would stretch beyond the limit; equality: threads "
          "keep their length (Zheng 2013, eq. 5.6). Equalities and contacts of a step are one problem; upper limits "
          "and contacts are solved in turn, and where both are tight steps may miss the tolerance, which a check "
          "counts")
      .required()
      .number("limit", &S::limit, "", between(0, 1), "largest Green-Lagrange strain along weft and warp")
      .defaultsTo("required for upper_limit; not allowed for equality")
      .number("tolerance", &S::tolerance, "", between(1e-5, 0.05),
              "strain by which points may miss it at the end of a step; much smaller ones cost projections and stir up "
              "the tensions, which take up what a step turns the threads")
      .number("stiffness", &S::stiffness_N_per_m, "N/m", between(100, 1e9),
              "threads that the limit holds resist as springs of this stiffness per width; yarns have 10 to 100 kN/m")
      .defaultsTo("worn: 100 N/m over the tolerance; structures: threads do not yield")
      .integer("max_projections", &S::max_projections, 1, 1000, "projections in a row before a step counts as failed")
      .choice(
          "points", &S::points,
          std::vector<std::pair<std::string, LimitPoints>>{{"vertices", LimitPoints::vertices},
                                                           {"threads", LimitPoints::threads},
                                                           {"gauss", LimitPoints::gauss},
                                                           {"centres", LimitPoints::centres}},
          "vertices: of the knot mesh (Zheng 2013, 5.4), on any sheet; they miss a motion that alternates across the "
          "threads, what loads do on it the fabric carries. threads: Greville points of each thread's strain, which "
          "miss none and give smooth stress on any number of cells; for whole patches of degree 2 or more whose "
          "threads follow their knot lines. gauss and centres, 2 x 2 points of each cell and one: for comparison on "
          "whole patches (Zheng 2013, 5.4): the first lock, the second lets cells hourglass")
      .choice(
          "method", &S::method,
          std::vector<std::pair<std::string, LimitMethod>>{
              {"fast", LimitMethod::fast}, {"closest", LimitMethod::closest}, {"provot", LimitMethod::provot}},
          "fast: fast projection (Zheng 2013, eq. 5.21). closest: the whole Newton iteration to the closest point on "
          "the constraints (eq. 5.15), slower; for comparison, of structures, mode equality. provot: what is stretched "
          "too far is drawn together one strain after the other, max_projections sweeps over all at most (Provot 1995; "
          "Man 2006, 2.1.1.1, without a number), of mode upper_limit; slow where much is stretched")
      .check([](const Entry& p, const S& s) {
        if (s.method == LimitMethod::closest && s.mode != LimitMode::equality)
          p.failAt("method", "closest goes with mode equality");
        if (s.method == LimitMethod::provot && s.mode != LimitMode::upper_limit)
          p.failAt("method", "provot goes with mode upper_limit");
        if (s.mode == LimitMode::upper_limit && !s.limit)
          p.failAt("limit", "is required for upper_limit: the largest strain");
        if (s.mode == LimitMode::equality && s.limit)
          p.failAt("limit", "has no meaning for equality, which holds the strain at 0; remove it");
      })
      .build();
}

}  // namespace schema
}  // namespace gambeson
