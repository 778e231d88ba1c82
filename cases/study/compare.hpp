#pragma once
/// The variants of a study against each other.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/series.hpp"
#include "analysis/verdict.hpp"
#include "analysis/viewer/viewer.hpp"
#include "cases/study/numbers.hpp"
#include "cases/study/population_answer.hpp"
#include "cases/study/run.hpp"
#include "cases/study/uncertainty.hpp"

namespace gambeson::study {

/// A variant's joint against the same of its baseline.
struct JointRatio {
  std::string joint;
  double peak = 0, rms = 0;  ///< ratios of sizes
  Likeness likeness;         ///< of the courses, from where torques count
};

/// Variants that differ along the main axis (the thickness, where there is one) alone.
struct VariantGroup {
  std::string label;                 ///< the levels of the other axes, the mesh left out: "walking"
  std::vector<std::size_t> members;  ///< on the finest mesh, in the order of the axis; of good runs and bad
  int baseline = -1;                 ///< variant; -1: none
  std::vector<std::string> joints;   ///< those that matter, the one that decides first
  std::string joint() const { return joints.empty() ? "" : joints[0]; }
};

/// An exponent of a torque along an axis whose levels are numbers.
struct AxisExponent {
  std::string axis, setting, joint, quantity;
  PowerLaw law;
  std::vector<double> x, y;
};

struct ElasticityRow {
  std::string setting, joint, quantity;
  Elasticities e;
  std::optional<double> measured;  ///< exponent of the thickness, of the same case, joint and quantity
};

/// A run against the same on the finest mesh.
struct MeshRow {
  std::string setting, joint;
  int level = -1;  ///< on the main axis
  int coarse_points = 0, fine_points = 0;
  double coarse_Nm = 0, fine_Nm = 0;  ///< peaks
  double difference = 0;              ///< of the peaks, relative to the fine one
  double error = 0;                   ///< the same, relative to the largest torque of the same level
  double course = 0;                  ///< RMS difference after 0.2 s, of the fine peak
  double bar = 0;                     ///< half width about the peak that pages show, of it
  std::size_t coarse = 0;             ///< variant
};

struct Comparison {
  std::vector<RunNumbers> runs;                 ///< of the variants
  std::vector<std::vector<JointRatio>> ratios;  ///< of the variants, empty without baseline
  std::vector<Light> lights;                    ///< of the variants, as their own pages show them
  int main_axis = -1, mesh_axis = -1, mesh_level = -1;
  std::vector<VariantGroup> groups;
  std::vector<AxisExponent> exponents;
  std::vector<ElasticityRow> elasticities;
  std::vector<MeshRow> meshes;
  std::vector<Budget> budgets;  ///< of references, in the order of the variants
  std::optional<PopulationAnswer> population;  ///< where wearers are drawn
  VerdictInput input;
  Verdict verdict;
};

Comparison compare(const Study& study, std::vector<RunNumbers> runs);

/// Largest |torque - standing| where torques count; nothing where the garment did not stand before.
std::optional<double> peakAboveStanding(const RunNumbers& run, const JointNumbers& joint);

/// Reads what the runs left, compares, and writes study.json, its tables as CSV, pictures/ and report.html. The bytes
/// depend on the runs' results alone. Outcomes of runs whose results cannot be read become bad.
void compareVariants(const Study& study, std::vector<Outcome>& outcomes, const std::filesystem::path& out);

// Its parts.
/// The bar of a number of a variant: its own reference's, or in per cent that of the reference that is most like it;
/// nothing where none was asked for. `taken_over`: whether it is another's.
std::optional<BarredNumber> barOf(const Study& study, const Comparison& c, std::size_t variant, const Headline& what,
                                  bool* taken_over = nullptr);
void findBudgets(const Study& study, Comparison& c);
/// A joint of a variant against its baseline's; null without one.
const JointRatio* ratioOf(const Comparison& c, std::size_t variant, const std::string& joint);
/// Whether others are compared with this variant.
bool isBaseline(const Study& study, std::size_t variant);
/// "walking, friction 0.3": the levels of a variant on all axes but those in `without`.
std::string settingOf(const Study& study, const Variant& variant, const std::vector<int>& without);
/// The level of a variant on the main axis; without one the variant's own label.
std::string memberName(const Study& study, const Comparison& c, std::size_t variant);
/// The order of a variant's level on the main axis, the baseline's first: what it is drawn like everywhere.
std::size_t memberOrder(const Study& study, const Comparison& c, std::size_t variant);
VerdictInput verdictInput(const Study& study, const Comparison& c);
void writeStudyTables(const Study& study, const Comparison& c, const std::filesystem::path& out);
/// A picture per member and wish, all of one wish at one time of their group and in the same colours.
struct SidePicture {
  std::size_t variant = 0, wish = 0;
  std::filesystem::path png;
  std::string caption;
};
std::vector<SidePicture> takeSidePictures(const Study& study, const Comparison& c, const std::filesystem::path& out,
                                          std::vector<std::string>& failures);
/// Up to four variants of the motion that decides, to look at side by side; none where there are not two.
std::vector<ViewerRun> takeViews(const Study& study, const Comparison& c, const std::filesystem::path& out,
                                 std::vector<std::string>& failures);
std::string studyPage(const Study& study, const Comparison& c, const std::vector<SidePicture>& pictures,
                      const std::vector<std::string>& failures, const std::vector<ViewerRun>& views = {});
/// What a case leaves out: "cloth does not touch cloth", "no air drag".
std::vector<std::string> switchedOff(const Case& c);

}  // namespace gambeson::study
