#pragma once
/// A case: everything that a run depends on, SI, read and fully validated at the door. Nothing behind it checks again.
/// What each field means in a case file, its default and range: cases/FIELDS.md, written by the table in
/// cases/wear/case/fields*.cpp.

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cases/cloth/fabric.hpp"
#include "cases/cloth/kind.hpp"
#include "cases/cloth/patch_fields.hpp"
#include "cases/cloth/regions.hpp"
#include "cases/cloth/strain_limit.hpp"
#include "cases/contact/contact.hpp"
#include "cases/input/json.hpp"
#include "cases/runs/picture.hpp"
#include "core/cloth/draft/garment.hpp"
#include "core/cloth/draft/mesh_draft.hpp"
#include "core/math/vec.hpp"
#include "core/motion/motion_options.hpp"
#include "human/body/mesh_sequence.hpp"
#include "human/character/character.hpp"
#include "human/manikin/measures.hpp"
#include "human/motion/aim.hpp"
#include "human/motion/kneel.hpp"
#include "human/motion/sit.hpp"
#include "human/motion/stairs.hpp"
#include "human/motion/step_over.hpp"
#include "human/motion/walk.hpp"
#include "human/recorded/marker_body.hpp"
#include "human/recorded/motion_file.hpp"
#include "human/scan/scan.hpp"
#include "human/skin/make_skin.hpp"
#include "tryon/pattern/armour.hpp"
#include "tryon/pattern/flat/seam_edit.hpp"
#include "tryon/pattern/trousers.hpp"

namespace gambeson {

struct StepControl;

// --- What is worn -----------------------------------------------------------------------------------------------

/// A flat rectangle, one patch: corner + s width axis_u + t height axis_v, s and t in [0, 1]. The axes are unit and
/// orthogonal.
struct SheetGarment {
  double width_m = 0, height_m = 0;
  int cells_u = 16, cells_v = 16;
  int degree = 2;
  Vec3 corner;
  Vec3 axis_u{1, 0, 0}, axis_v{0, 1, 0};
};

/// A flat disc, cut out of a sheet; u runs along axis_u, v along axis_v.
struct DiscGarment {
  double radius_m = 0;
  int cells = 16;
  int degree = 2;
  Vec3 center;
  Vec3 axis_u{1, 0, 0}, axis_v{0, 1, 0};
};

/// A circular tube from `start` along `axis` (unit), cut lengthwise into `patches` equal patches. u runs around, v
/// along.
struct TubeGarment {
  double radius_m = 0, length_m = 0;
  int cells_around = 24, cells_along = 24;
  int degree = 2;
  int patches = 1;
  Vec3 start;
  Vec3 axis{1, 0, 0};
};

/// Shorts drafted on the body of the case, six patches.
struct ShortsGarment {
  double inseam_m = 0.20;            ///< crotch to hem
  double rise_m = 0.25;              ///< crotch to waist edge
  double crotch_ease_m = 0.010;      ///< the body's crotch to that of the shorts
  double ease = 0.06;                ///< garment girth = (1 + ease) body girth
  std::optional<double> waist_ease;  ///< of the waist edge, where it is another
  double cell_m = 0.02;              ///< wanted size of a cell
  int degree = 2;
};

/// Trousers of four rectangles for the body of the case (tryon/pattern/trousers.hpp, where the defaults are).
struct TrousersGarment : TrousersPattern {};

/// Drafted on the body of the case, over the garments before it (tryon/pattern/armour.hpp, where the defaults are).
struct BeltGarment : BeltPattern {};
struct ShirtGarment : ShirtPattern {};
struct SkirtGarment : SkirtPattern {};

/// A garment read from a file.
struct FileGarment {
  std::filesystem::path path;
};

/// A garment of triangles read from a mesh.
struct MeshGarment {
  std::filesystem::path path;
  MeshRest rest = MeshRest::fabric;
  double unit_m = 1, uv_unit_m = 1;  ///< length of a unit of the file, and of its uv
};

/// Flat panels from a file of a pattern, each on its grain (tryon/pattern/flat/panel_garment.hpp), sewn around the
/// wearer.
struct PatternGarment {
  std::filesystem::path path;
  double cell_m = 0.02;
  int degree = 2;
  double close_within_s = 5;    ///< by then its seams are closed
  std::vector<SeamEdit> seams;  ///< that are otherwise than the file has them
};

/// Virtual stitching, Zheng 2013, section 6.3: the panels start apart, and springs along the seams close them.
struct Stitching {
  double offset_m = 0.05;            ///< of the panels from where they are drafted
  double stiffness_N_per_m2 = 4000;  ///< k of eq. 6.2, per length of seam
  double damping_kg_per_m_s = 50;    ///< eta of eq. 6.2, per length of seam
  double close_m = 0.005;            ///< the panels are sewn once no pair is further apart
  double within_s = 3;               ///< by then they must be
};

struct GarmentCase {
  std::string name;  ///< where there are several: what supports and tables call it; unique
  std::variant<SheetGarment, DiscGarment, TubeGarment, ShortsGarment, TrousersGarment, BeltGarment, ShirtGarment,
               SkirtGarment, FileGarment, MeshGarment, PatternGarment>
      shape;
  ClothModel cloth;
  Vec3 position_m;                        ///< moves the shape
  std::optional<FabricCase> fabric;       ///< that of the case where absent
  std::vector<FabricCase> other_fabrics;  ///< what material fields choose from, beside the fabric
  std::vector<FieldsCase> fields;         ///< thickness, fibre angle and material over its patches
  std::vector<RegionCase> regions;        ///< named parts, each with a factor on its thickness
  /// Displacement of each control point along the normal, uniform in -amplitude .. amplitude, that the motion starts
  /// from; the rest shape has none.
  double noise_m = 0;
  int noise_seed = 1;
  /// Contact samples per cell edge; 0: the Greville points.
  int samples_per_cell = 2;
  /// Rotational spring of C0 seams [N m/(m rad)].
  double seam_stiffness_N = 0.01;
  /// Turns the weft about the patch's normal; at 0 it lies along u in a sheet, lengthwise in a tube and in shorts.
  double weft_angle_rad = 0;
  std::optional<FrictionLaw> friction;  ///< with bodies, where it differs
  std::optional<Stitching> stitching;   ///< how it is put on where garments are dressed one by one; else by projecting
};

// --- Who wears it -----------------------------------------------------------------------------------------------

struct TrajectoryMotion {
  std::filesystem::path file;
};

struct StandMotion {
  double duration_s = 1;
};

/// Feet that are left out at first, so that trousers can be pulled up over the legs (Man 2006, 5.4, fig. 47).
struct FeetLeftOut {
  double back_s = 1;    ///< when they begin to come back
  double grow_s = 0.3;  ///< from then on they grow to their size
};

/// A manikin by name or by measures, a URDF with a body file (which may be empty: the URDF's own geometry then), a
/// character, a scan, or segments between markers.
struct HumanCase {
  std::string manikin;
  std::optional<ManikinMeasures> measures;
  std::filesystem::path urdf, body;
  std::optional<CharacterOptions> character;
  std::optional<ScanOptions> scan;
  std::vector<MarkedSegment> segments;
  std::optional<SkinOptions> skin;  ///< around the manikin; where absent, its ellipsoids are the surface
  std::optional<FeetLeftOut> feet;  ///< where absent, they are there at all times
  std::variant<StandMotion, WalkOptions, StairOptions, AimOptions, TrajectoryMotion, MotionFileOptions, SitOptions,
               KneelOptions, StepOverOptions, MarkersOptions>
      motion;
};

// --- What holds it ----------------------------------------------------------------------------------------------

/// An edge of a garment, which is named where there are several: by name (sheet: "u0" "u1" "v0" "v1"; tube: "start"
/// "end"; those that are drafted and files: as the garment says), or, with an empty name, by patch and side.
struct EdgeCase {
  std::string garment;
  std::string name;
  int patch = 0;
  Side side = Side::u0;
};

/// Points held in the world, or moved by a drive, until they are let go.
struct HeldSupport {
  EdgeCase edge;  ///< garment and edge or patch
  Drive drive;
  std::optional<double> release_s;
};

/// Rows of control points held: 1 holds the edge, 2 also its tangent.
struct FixedSupport : HeldSupport {
  int rows = 1;
};

/// Elastic springs from the edge's samples to the points of a link where they stand when the springs are attached.
struct SpringSupport {
  EdgeCase edge;
  double stiffness_N_per_m2 = 200;  ///< force per displacement and length of edge
  std::string link;
};

/// The control points that shape a point of a patch held.
struct PinnedSupport : HeldSupport {
  double s = 0.5, t = 0.5;
};

/// All points of a patch held.
struct PatchSupport : HeldSupport {};

/// A cord along an edge that is drawn tight, as a belt or a drawstring is: neighbouring samples attract each other,
/// with `tension_N` where they are as far apart as at rest and in proportion to their distance, so the cord has no
/// length of its own. It is drawn in `draw_s`, further at the end of each window.
struct CordSupport {
  EdgeCase edge;
  double tension_N = 30;
  std::optional<double> from_s;  ///< absent: it is drawn from the start on
  double draw_s = 0.1;
};

using SupportCase = std::variant<FixedSupport, SpringSupport, PinnedSupport, PatchSupport, CordSupport>;

// --- How it touches, and the air -------------------------------------------------------------------------------

struct AirCase {
  double drag_kg_per_m2s = 0;
  Vec3 velocity_m_per_s;
  bool with_pelvis = false;  ///< the air moves with the pelvis's mean velocity instead
};

// --- What studies vary --------------------------------------------------------------------------------------------

/// Multiples of what the case says, 1 each unless a study asks what a torque depends on; cases/wear/case/factors.hpp
/// applies them.
struct FactorsCase {
  double thickness = 1, bending = 1, membrane = 1, weight = 1, inertia = 1, drag = 1, friction = 1;
  bool operator==(const FactorsCase&) const = default;
};

// --- Dressing, time, output, analysis ---------------------------------------------------------------------------

/// Virtual projecting, Zheng 2013, section 6.3.
struct Projecting {
  double clearance_m = 0.005;  ///< free distance that the shrunk body leaves
  double grow_s = 0.3;         ///< time in which it grows back
};

/// What laws remember of a dressed state.
enum class DressedHistory { kept, wiped };

struct DressingCase {
  std::optional<Projecting> projecting;
  bool layer_by_layer = false;  ///< each garment is put on by itself, then all are worn together
  std::filesystem::path from;   ///< dressed state that another run or `gambeson dress` left
  DressedHistory history = DressedHistory::kept;
  double settle_s = 0.5;  ///< time at rest before the motion starts
};

struct TimeCase {
  /// Where absent, the motion's duration. Always present where the case has no human.
  std::optional<double> duration_s;
  double step_safety = 0.9;  ///< of the stable step
  double max_step_s = 1e-3;
  double step_s = 0;  ///< where positive: every step, stable or not
  MotionOptions motion;
  bool audit = false;  ///< velocity Verlet keeps account of what it makes or takes of energy; other schemes always do

  bool auditsEnergy() const { return audit || motion.scheme != MotionScheme::verlet; }
  StepControl control() const;
};

struct OutputCase {
  double window_s = 0.01;     ///< forces are impulses over this time
  double frame_s = 0.02;      ///< a multiple of window_s
  double checkpoint_s = 0.1;  ///< a multiple of frame_s
  std::optional<std::vector<PictureCase>> pictures;  ///< absent: the usual one and a film
  bool viewer = true;  ///< the page has one
};

enum class Counting { distal_segment, all_distal };
enum class Task { none, natural_walk, natural_stairs, aiming };

struct AnalysisCase {
  std::vector<std::string> joints;  ///< empty: every joint that moves
  Counting counting = Counting::distal_segment;
  Task task = Task::none;
};

/// Pressure on one part of the body: up to `amber` in the mean over time at the place that bears most it is green, from
/// `red` on, or above `peak` at any time, red.
struct ComfortLimit {
  double amber_Pa = 2000, red_Pa = 4270, peak_Pa = 9810;
};

/// What a wearer accepts. Defaults are suggestions for a first look, not a standard:
/// shoulders     14 kPa where a strap irritates the skin (Holewijn 1990), 7 half of it, 20 kPa a limit of straps
///               (Stevenson, Bryant 2004)
/// waist         4.67 kPa (35 mmHg) where waistbands are called uncomfortable (Sen'i Gakkaishi 47(6):282, 1991)
/// others        4.27 kPa (32 mmHg) closes capillaries (Landis 1930), 9.81 kPa (100 gf/cm^2) where garments hurt
///               (Denton 1972), 2 kPa (20 gf/cm^2) comfortable (Denton)
/// effort        no published limit was found; those of human/data/effort_limits.json
struct ComfortCase {
  ComfortLimit shoulder{7000, 14000, 20000}, chest, waist{2000, 4670, 9810}, hips, thigh, arm, other;
  double wear_s = 1800;                           ///< time over which the dose is taken
  double sensor_m = 0.03;                         ///< width over which pressure is averaged
  double effort_amber = 0.05, effort_red = 0.15;  ///< added torque, of the natural moment
};

// --- The case ---------------------------------------------------------------------------------------------------

struct Case {
  std::string name, description;
  Vec3 gravity_m_per_s2{0, 0, -9.81};
  std::vector<GarmentCase> garments;  ///< innermost first, at least one
  FabricCase fabric;                  ///< of garments without one of their own
  std::optional<HumanCase> human;
  std::vector<ObstacleCase> obstacles;
  std::vector<SupportCase> supports;
  ContactCase contact;
  std::optional<StrainLimitCase> strain_limit;
  AirCase air;
  FactorsCase factors;
  DressingCase dressing;
  TimeCase time;
  OutputCase output;
  AnalysisCase analysis;
  ComfortCase comfort;

  std::filesystem::path file;          ///< where it was read
  std::vector<std::string> overrides;  ///< "path=value" of the command line
};

/// As the shell takes them, without what the verdict asks of them.
inline std::vector<Fabric> otherFabrics(const GarmentCase& g) {
  return {g.other_fabrics.begin(), g.other_fabrics.end()};
}
inline const FabricCase& fabricOf(const Case& c, const GarmentCase& g) { return g.fabric ? *g.fabric : c.fabric; }

/// Reads and checks a case file. `overrides` ("fabric.thickness=0.4 mm") replace or add values before the checks.
/// Relative paths in the file resolve against its folder, those of overrides against the current folder.
/// The files that the case names are read once as well, so that the run does not stumble over them.
/// Throws InputError with file, line and key ("command line" and the key for overrides).
Case readCase(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same from a file already read, with values put in their places.
Case readCase(const JsonNode& root, const std::filesystem::path& file);

/// The case of a finished run, as writeCase left it. It was checked before its run; files that it names may be gone or
/// changed meanwhile, and none is looked at.
Case readRecordedCase(const std::filesystem::path& file);

/// The case written out in full as JSON, every default included; readCase gives the same case back.
std::string writeCase(const Case& c);

/// Hexadecimal hash of all that the results depend on: the written-out case and the contents of the files that it
/// names.
std::string caseIdentity(const Case& c);

/// The case file and every file that it names, as far as there are such.
std::vector<std::filesystem::path> inputsOf(const Case& c);

}  // namespace gambeson
