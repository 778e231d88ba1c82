#pragma once
/// What laboratories' terms are in others: pure functions, SI. Where a sheet says the same thing twice, what it says
/// must agree; the readers of cards (card_fields.cpp) ask these.

#include <array>

namespace gambeson::lab {

constexpr double kGravity_m_per_s2 = 9.80665;      ///< of 1 gf, and of weights that laboratories turn into forces
constexpr double kGfPerCm_N_per_m = 0.980665;      ///< 1 gf/cm
constexpr double kGfCm2PerCm_Nm = 9.80665e-5;      ///< 1 gf cm^2/cm, of B
constexpr double kGfPerCmDeg_N_per_m = 56.187965;  ///< 1 gf/(cm deg) per radian, of G

/// LT = WT/(EMT F/2) of KES-FB1 (Kawabata 1980): the work of a tensile test over that of a straight line to the same
/// end. Work per area at rest [J/m^2], extension, force per width [N/m]. Valid: all > 0.
double linearity(double work_J_per_m2, double extension, double force_N_per_m);

/// B = W g c^3 [N m] from the bending length c [m] and the weight W [kg/m^2]; ASTM D1388-18, eq. 2 (there in
/// ug cm and mg/cm^2), ISO 9073-7, and FAST-2, B = 9.81e-6 W c^3 in uN m, g/m^2 and mm. F. T. Peirce, J. Text. Inst.
/// 21, T377 (1930). Of a strip whose overhang L droops until its chord slopes by 41.5 degrees c is L/2.
double rigidityOfLength(double bending_length_m, double weight_kg_per_m2);
/// The inverse: c = (B/(W g))^(1/3) [m].
double lengthOfRigidity(double rigidity_Nm, double weight_kg_per_m2);

/// G [N/m per radian] from the extension EB5 along the bias under 5 gf/cm: threads that do not stretch turn by
/// 2 EB5 against each other under a shear force of half the tension, G = 5 gf/cm/(4 EB5); FAST-3 prints 123/EB5 of
/// EB5 in % (CSIRO, FAST instruction manual, 1989; A. De Boos, D. Tester, CSIRO report WT92.02, 1994). Valid for EB5 of
/// a few per cent of cloth whose threads stretch far less.
double shearOfBias(double extension);
double biasOfShear(double G_N_per_m);

/// F = B (E20 - E5)/(14.7 N/m) [m^2], the formability of FAST: rigidity times the extension between 5 and 20 gf/cm over
/// the difference of these loads (as above).
double formability(double rigidity_Nm, double extension_5, double extension_20);

/// The loads of FAST-3 at which E5, E20 and E100 are read: 5, 20 and 100 gf/cm [N/m].
constexpr std::array<double, 3> kFastLoads_N_per_m{5 * kGfPerCm_N_per_m, 20 * kGfPerCm_N_per_m, 100 * kGfPerCm_N_per_m};

/// Secant stiffness A [N/m] of n = A E (core/material/laws/membrane.hpp) of a strip that keeps its width, at an
/// engineering strain e under a force per width F: A = F/((1 + e)(e + e^2/2)).
double stiffnessAt(double force_N_per_m, double e);
/// The engineering strain of that law under a force per width (the inverse; F > 0).
double strainUnder(double force_N_per_m, double stiffness_N_per_m);
/// Green-Lagrange strain e + e^2/2.
constexpr double greenOf(double e) { return e + 0.5 * e * e; }

}  // namespace gambeson::lab
