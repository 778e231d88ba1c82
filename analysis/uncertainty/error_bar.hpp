#pragma once
/// How far a number may be off, and by what.

#include <array>
#include <optional>
#include <string_view>

namespace gambeson {

/// What makes a number uncertain.
enum class BarPart { none, mesh, step, fabric };

/// Half widths of a number's error bar, in its unit, each so that it holds the true value in about 19 of 20 cases
/// (k = 2 of the Guide to the expression of uncertainty in measurement, JCGM 100:2008, 6.3.3); absent: not known.
struct ErrorBar {
  std::optional<double> mesh, step, fabric;

  /// The root of the sum of squares of the parts that are known, which have nothing to do with each other (JCGM 100,
  /// eq. 10); nothing where none is known.
  std::optional<double> combined() const;
  /// The largest of them; none where none is known or all are 0.
  BarPart largest() const;
  std::optional<double> of(BarPart part) const;
  /// Of the square of the whole; 0 where it is not known.
  double share(BarPart part) const;
};

inline constexpr std::array kBarParts{BarPart::mesh, BarPart::step, BarPart::fabric};
std::string_view nameOf(BarPart part);

/// The multiple of a standard deviation that an error bar is.
inline constexpr double kCoverage = 2;

/// About which of two results a bar is drawn.
enum class About { coarse, fine };

/// Roache's grid convergence index (J. Fluids Eng. 116, 1994, p. 405; ASME V&V 20-2009, section 2-4): the error of a
/// result about the exact one from its difference `d` >= 0 to that with cells or steps `ratio` times finer, where the
/// error goes with their size to the power of `order`:
///   about the fine result    U = safety d/(ratio^order - 1),
///   about the coarse result  U = safety d ratio^order/(ratio^order - 1).
/// In the unit of d. Valid for ratio > 1, order > 0, both within the range where the error falls so.
double gridBar(double difference, double ratio, double order, double safety, About about);

/// Of meshes: from the difference of two of `coarse_points` and `fine_points`, whose cells differ by the root of the
/// points' ratio.
double meshBar(double difference, int coarse_points, int fine_points, About about);

/// Of a step: from the difference to the same with half of it, about the longer one. Contact and friction leave steps
/// of first order at best.
double stepBar(double difference);

}  // namespace gambeson
