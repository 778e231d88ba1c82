#pragma once
/// From a case to all that a run and its analysis need: garment, human, motion, stage and model.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/wear/case/case.hpp"
#include "cases/wear/scene/stage.hpp"
#include "cases/wear/scene/supports.hpp"
#include "core/cloth/draft/garment.hpp"
#include "core/cloth/draft/mesh_draft.hpp"
#include "core/motion/velocity_verlet.hpp"
#include "human/body/body.hpp"
#include "human/motion/foot_report.hpp"
#include "human/motion/motion.hpp"
#include "tryon/pattern/flat/panel_fit.hpp"

namespace gambeson {

struct MadeBodies;  // cases/wear/scene/bodies.hpp

/// Contact of one garment with bodies: freely, in a belt's press (of the belt itself, and of what lies under it), or of
/// an edge on springs, which pull it onto the body.
enum class Press { free, belt, held };
struct ContactGroup {
  std::string garment;  ///< the garment's name
  Press press = Press::free;
  bool operator==(const ContactGroup&) const = default;
};

/// The garments of a case as they are made, before they are cloth: drafted or read, innermost first.
struct Wardrobe {
  std::vector<Garment> drafts;
  std::vector<std::optional<MeshDraft>> meshes;  ///< of each that is a mesh from the start
};

/// Constant after it is built. Time 0 is where the motion starts; dressing and settling lie before it.
struct Scenario {
  Case definition;
  std::optional<Human> human;
  std::unique_ptr<Motion> motion;
  Vec3 mean_velocity_m_per_s;  ///< of the pelvis in walking and climbing
  double air_ramp_s = 0;       ///< in which air that goes along with it comes up to speed
  Wardrobe wardrobe;
  std::unique_ptr<Model> model;
  std::unique_ptr<CaseStage> stage;
  std::vector<std::string> bodies;        ///< links of the human, then the case's own obstacles
  std::vector<int> body_of_obstacle;      ///< index in `bodies`; -1: the human's skin, whose segments are links
  std::vector<std::string> patch_names;   ///< where there are several garments, each starts with its garment's
  std::vector<std::string> fabric_names;  ///< of the garments, each once
  std::vector<int> samples_per_cell;      ///< of the patches
  std::vector<SupportGroup> supports;
  std::optional<FootReport> feet;  ///< whether they could stand; none without feet
  /// Where contact with bodies is told apart: the patches, then what lies under a belt, then edges on springs. A sample
  /// belongs to the last of these that holds it.
  std::vector<std::string> contact_regions;
  std::vector<int> contact_region;  ///< of the samples
  std::vector<ContactGroup> contact_groups;
  std::vector<int> contact_group;  ///< of the samples
  /// What a user should know of the case before its results: what bears on these, and what was found in files of the
  /// wearer and of obstacles.
  std::vector<std::string> notes, facts;
  /// How wide flat panels are around the wearer before they are sewn, by garment; none of a garment of another kind,
  /// nor of a recording.
  std::vector<std::vector<PanelGirth>> panel_girths;
  std::vector<Vec3> start_m;          ///< where the free points start; empty: where they are drafted
  std::vector<Vec3> shift_m;          ///< of the free points at the start, from the rest shapes; empty: none
  std::vector<double> start_history;  ///< what laws remember at the start; empty: nothing, they are new
  double start_s = 0, end_s = 0;

  /// Where the origin of each body's frame stands.
  std::vector<Pose> bodyPoses(double time_s) const;
  std::vector<Placement> obstaclePlacements(double time_s) const;
  /// Which of `bodies` an obstacle's point belongs to; of a skin the link of most weight at the nearest vertex.
  int bodyOf(int obstacle, const MaterialPoint& touched) const;
  bool hasSkin() const { return human && human->skin; }
};

/// What a foot report says, as a sentence without its full stop.
std::string feetText(const FootReport& feet);

/// Bridges the folds of the human's skin through settling and the motion up to until_s, where the case asks for it, and
/// says so in the notes (human/skin/bridge_folds.hpp). To be called again where the stage is given other postures.
void bridgeSkin(Scenario& s, double until_s);

/// What a run starts from: the rest shapes, or where garments are placed, with their noise, or where they were put on.
/// Springs are anchored where they are drafted.
State startOf(const Scenario& scenario, StepWork& work);

/// Throws InputError (with the case's file) where the case cannot be built, RunError where the body cannot be freed.
std::unique_ptr<Scenario> buildScenario(const Case& c);
/// The same of a recording: with the bodies and garments that were made for its run, and none made again. The body
/// through dressing, which only a run works out, is not in it.
std::unique_ptr<Scenario> buildRecorded(const Case& c, MadeBodies bodies, Wardrobe wardrobe);
/// A case of one garment, which is drafted as garment `garment` of `whole`: over those before it, which it has not on.
std::unique_ptr<Scenario> buildAlone(const Case& one, const Case& whole, std::size_t garment);
/// The same with its panels apart and springs along its seams (virtual stitching), beside the body that stands as at
/// time 0. Ends at 0. Throws InputError where the garment is not to be stitched.
std::unique_ptr<Scenario> buildPanels(const Case& one, const Case& whole, std::size_t garment);

}  // namespace gambeson
