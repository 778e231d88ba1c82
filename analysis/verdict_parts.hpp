#pragma once
/// The pieces of verdictOf.

#include "analysis/verdict.hpp"

namespace gambeson::verdict {

/// What people say of the levels of an axis.
struct RoleWords {
  const char* before;  ///< "for male_p95", "in stairs", "with thickness x 1"
  const char *one, *many;
  const char* costs;  ///< "male_p95 pays 2 Nm", "stairs cost", "friction 0.5 costs"
};
RoleWords wordsOf(Role role);
/// "male_p95 pays", "friction 0.5 costs", "as springs it costs"
std::string whoPays(const VerdictInput& in, const Option& option);

inline const Option& at(const VerdictInput& in, int i) { return in.options[static_cast<std::size_t>(i)]; }
std::string percent(double part);
/// " (text)", empty for an empty text.
std::string bracketed(const std::string& text);
std::string capital(std::string text);
/// Opens a sentence with an option: names that a study gives its levels itself are kept as they are.
std::string opening(const std::string& text, const VerdictInput& in);
std::vector<std::string> motionsOf(const Option& option);
const Option::Cost* costAt(const Option& option, const std::string& motion, const std::string& joint);
/// "2.00 Nm at the left hip (flexion), 4 % of its natural 50.0 Nm (stairs)"
std::string costText(const Option::Cost& cost, const VerdictInput& in);
/// No run of it failed, and it costs something.
bool isUsable(const Option& option);
long usableCount(const VerdictInput& in);
/// The light of an option by its torque alone, were all torques off by a relative error.
Light optionLight(const Option& option, const VerdictInput& in, double error = 0);
/// How many times as much `b` costs as `a`, where each is worst.
double factorOf(const Option& a, const Option& b);
const VerdictInput::Exponent* exponentOf(const VerdictInput& in, const Option::Cost& cost);
/// Garments at a size: those that go with it, from the option's own.
std::string garmentsAt(const VerdictInput& in, int option, double size);
/// A choice that an error of this size would change is said to be only just right.
constexpr double kNarrow = 0.1;
/// Pressure on the body that is furthest from comfortable, and with which option: of the one taken, or where none is
/// chosen of all.
struct LeastComfortable {
  const Option* option = nullptr;
  const Option::Comfort* comfort = nullptr;
};
LeastComfortable leastComfortable(const VerdictInput& in, const Verdict& v);

/// "the fabric stretches", "the fabric of shirt stretches"
std::string whoStretches(const Stretch& s);
/// "the 15 % that it is meant for", "the 2 % that its law is meant for"
std::string meantFor(const Stretch& s);

// verdict_words.cpp: of a verdict whose option, light and margin are known.
std::string doubtOf(const VerdictInput& in, const Verdict& v);
std::string sentenceOf(const VerdictInput& in, const Verdict& v);
std::string enoughOf(const VerdictInput& in, const Verdict& v);
std::string numbersOf(const VerdictInput& in, const Verdict& v);

// verdict_reasons.cpp
std::string estimateOf(const VerdictInput& in, const Verdict& v);
std::string whyOf(const VerdictInput& in, const Verdict& v);
std::string comfortOf(const VerdictInput& in, const Verdict& v);
/// Says and rates how sure the choice is, or which is worst.
void judgeChoice(const VerdictInput& in, Verdict& v);

}  // namespace gambeson::verdict
