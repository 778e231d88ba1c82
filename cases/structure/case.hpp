#pragma once
/// A structure under test: a sheet, its material, supports and loads, and what is asked of it. The kinds of case beside
/// a garment that is worn: static (an equilibrium path), dynamic (motion in time), modal (natural frequencies).
/// What each field means in a case file, its default and range: cases/FIELDS.md, written by the tables in
/// cases/structure/fields*.cpp.

#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "analysis/render/render.hpp"
#include "cases/cloth/fabric.hpp"
#include "cases/cloth/strain_limit.hpp"
#include "cases/contact/contact.hpp"
#include "cases/input/json.hpp"
#include "cases/structure/sheet.hpp"
#include "core/motion/motion_options.hpp"
#include "core/statics/statics.hpp"

namespace gambeson {

enum class StructureKind { statics, dynamics, modal };

// --- Material ----------------------------------------------------------------------------------------------------

/// A homogeneous sheet of a St. Venant-Kirchhoff material; it bends as its thickness says.
struct IsotropicMaterial {
  double young_Pa = 0, poisson = 0, thickness_m = 0;
  std::optional<double> density_kg_per_m3;
};
struct OrthotropicMaterial {
  double young_weft_Pa = 0, young_warp_Pa = 0, shear_Pa = 0, poisson = 0, thickness_m = 0;
  std::optional<double> density_kg_per_m3;
};
struct LaminateMaterial {
  std::vector<Ply> plies;  ///< from the bottom (-normal) to the top
  std::optional<double> density_kg_per_m3;
};

struct MaterialCase {
  std::variant<IsotropicMaterial, OrthotropicMaterial, LaminateMaterial, Fabric> law;
  bool tension_field = false;
  std::filesystem::path card;  ///< of a fabric; empty: none
  /// Of a fabric, Green-Lagrange strains that it may reach; absent: not said.
  std::optional<double> limit_strain_weft, limit_strain_warp;
  std::optional<EnergySource> energy_source;  ///< that a fabric's law is of
  bool thickness_assumed = false;             ///< FabricCase
};
/// As the shell takes it; a density that is not given is 0.
Fabric fabricOf(const MaterialCase& material);

// --- Supports and loads ------------------------------------------------------------------------------------------

struct StructureSupport {
  std::variant<EdgeAt, PointAt> where;
  std::vector<Vec3> hold;  ///< unit directions
  bool clamp = false;
  std::optional<Vec3> symmetry;  ///< normal of the mirror plane
  std::optional<Vec3> tie;       ///< direction in which all points of the edge move alike
  std::optional<Vec3> move_m;    ///< displacement at program value 1
  std::string program;           ///< of `move`; empty: the load factor (static), 1 (dynamic)
};

enum class LoadSort { force, force_per_length, moment, moment_per_length, force_per_area, pressure, gravity };

struct StructureLoad {
  LoadSort sort = LoadSort::force;
  std::variant<std::monostate, EdgeAt, PointAt> where;  ///< none: the whole sheet
  std::optional<int> patch;                             ///< of a load on the sheet: this patch alone
  Vec3 vector;                                          ///< of forces and gravity, SI
  double amount = 0;                                    ///< of moments and pressure, SI
  std::string program;                                  ///< empty: the load factor (static), 1 (dynamic)
};

struct NamedProgram {
  std::string name;
  std::vector<double> at, value;
};

// --- What is asked -----------------------------------------------------------------------------------------------

struct DampingCase {
  double mass_per_s = 0, stiffness_s = 0;  ///< Rayleigh: C = a M + b K
  double drag_kg_per_m2s = 0;
};

/// Newmark and generalised-alpha solve for unknowns; `points`: a MotionScheme steps free points, with contact.
enum class TimeScheme { newmark, generalised_alpha, points };

struct DynamicOptions {
  TimeScheme scheme = TimeScheme::generalised_alpha;
  double beta = 0.25, gamma = 0.5;  ///< Newmark
  double spectral_radius = 0.8;     ///< generalised-alpha
  double step_s = 0;                ///< explicit: 0 takes `safety` of the stable one
  double safety = 0.9;              ///< of the stable step 2 / omega, explicit
  double end_s = 1;
  int iterations = 20;
  double tolerance = 1e-8;
  bool lumped_mass = false;  ///< Newmark, generalised-alpha; the others always lump
  MotionOptions motion;      ///< of TimeScheme::points

  bool stepsPoints() const { return scheme == TimeScheme::points; }
  bool lumps() const { return lumped_mass || stepsPoints(); }
};

struct ModalOptions {
  int count = 6;
  bool lumped_mass = false;
  bool at_equilibrium = false;  ///< under the loads at factor 1, else at rest without loads
};

/// How a dynamic run starts; at rest where all is absent.
struct InitialCase {
  std::optional<NoiseCase> noise;  ///< displacement
  Vec3 velocity_m_per_s;
};

// --- Output ------------------------------------------------------------------------------------------------------

struct OutputPoint {
  std::string name;
  PointAt where;
};
struct OutputEdge {
  std::string name;
  EdgeAt where;
};

enum class ShapesKept { none, last, all };
/// automatic: displacement of a mode, else stress.
enum class StructureField { automatic, plain, displacement, stress, strain };

struct StructurePicture {
  StructureField field = StructureField::automatic;
  View view = View::front_right;
  double scale = 1;  ///< of displacements; of a mode: its largest displacement as a part of the sheet's size
  int mode = 1;      ///< modal: which
  int width = 1100, height = 850;
};

struct StructureOutput {
  std::vector<OutputPoint> points;
  std::vector<OutputEdge> edges;
  ShapesKept shapes = ShapesKept::last;
  std::optional<double> interval_s;  ///< dynamic: between rows of the table and kept shapes
  bool audit = false;                ///< dynamic: balance of energy and momentum
  int samples_per_cell = 2;
  bool thread_strains = false;             ///< dynamic: strains of weft and warp at vertices and Gauss points
  std::vector<StructurePicture> pictures;  ///< none: one of the last shape
};

// --- The case ----------------------------------------------------------------------------------------------------

struct StructureCase {
  StructureKind kind = StructureKind::statics;
  std::string name, description;
  SheetCase sheet;
  MaterialCase material;
  std::vector<MaterialCase> other_materials;
  std::vector<StructureSupport> supports;
  std::vector<StructureLoad> loads;
  std::vector<NamedProgram> programs;
  StaticOptions statics;  ///< also of the equilibrium that a modal case is about
  DynamicOptions dynamics;
  ModalOptions modal;
  DampingCase damping;
  std::optional<StrainLimitCase> strain_limit;  ///< dynamic, explicit steps
  std::vector<ObstacleCase> obstacles;          ///< dynamic, explicit steps
  std::optional<ContactCase> contact;           ///< dynamic, explicit steps: the sheet touches them, and itself
  InitialCase initial;
  StructureOutput output;

  std::filesystem::path file;          ///< where it was read
  std::vector<std::string> overrides;  ///< "path=value" of the command line
};

/// Reads and checks a case file of these kinds; as readCase of cases/wear/case/case.hpp. The sheet is built and the
/// supports are tried once, so that a run does not stumble over them.
StructureCase readStructureCase(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});
/// The same from a file already read, with values put in their places.
StructureCase readStructureCase(const JsonNode& root, const std::filesystem::path& file);
/// The case of a finished run, as writeCase left it: no file that it names is looked at, and nothing is built.
StructureCase readRecordedStructureCase(const std::filesystem::path& file);
/// The case written out in full as JSON; readStructureCase gives the same case back.
std::string writeCase(const StructureCase& c);
/// As caseIdentity of cases/wear/case/case.hpp.
std::string caseIdentity(const StructureCase& c);
/// The case file and every file that it names, as far as there are such.
std::vector<std::filesystem::path> inputsOf(const StructureCase& c);

}  // namespace gambeson
