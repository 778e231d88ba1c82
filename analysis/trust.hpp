#pragma once
/// What a light stands on beside its number: checks, and how far the fabric was stretched. The page of a run and that
/// of a study judge by the same rule, so that one cannot be green where the other warns.

#include <span>
#include <string>

#include "analysis/compare.hpp"

namespace gambeson {

/// How far a fabric stretches against the range that it is meant for: Green-Lagrange strains.
struct Stretch {
  double limit = 0;
  double most = 0;        ///< 99 % of the patch that stretches most stays below
  double largest = 0;     ///< of single spots
  bool stated = false;    ///< the limit is the fabric's own, and not that of the law that it is computed with
  std::string garment{};  ///< empty where there is one only
  std::string along{};    ///< "weft", "warp"; empty: in any direction
  /// Single spots too: where cloth tears, one is enough. NaN fails.
  bool holds() const { return largest <= limit; }
};

/// "Fabric stretches by up to 40 % (99 % of it by less than 13 %), and its law is meant for less than 2 %: beyond that
/// its stress is extrapolated."
std::string sentenceOf(const Stretch& stretch);

/// The one that goes furthest beyond its limit, or comes nearest to it; null without any.
const Stretch* worstOf(std::span<const Stretch> all);

/// Of one run, or of several.
struct Trust {
  int failing = 0;    ///< checks that do not hold
  int spoiling = 0;   ///< of them those that leave none of the numbers
  int stretched = 0;  ///< fabrics beyond their range
  int unplayed = 0;   ///< runs that ended before what they are to judge began
  void check(bool holds, bool spoils) { failing += !holds, spoiling += !holds && spoils; }
  void stretch(const Stretch& s) { stretched += !s.holds(); }
  void add(const Trust& t) {
    failing += t.failing, spoiling += t.spoiling, stretched += t.stretched, unplayed += t.unplayed;
  }
  /// No check says not to rely on the numbers.
  bool reliable() const { return failing == 0; }
  bool whole() const { return reliable() && stretched == 0 && unplayed == 0; }
};

/// The light that may be shown: green only where everything holds, none at all where a check spoils the numbers.
Light shownLight(Light by_number, const Trust& trust);

}  // namespace gambeson
