#pragma once
/// The pieces of writeResults.

#include "analysis/render/camera.hpp"
#include "analysis/report/report.hpp"
#include "cases/wear/results/measure.hpp"
#include "cases/wear/results/results.hpp"

namespace gambeson {

/// Replaces DIR/summary.json atomically.
void writeSummary(const Scenario& scenario, const RecordingReader& recording, const Measured& measured,
                  const RunFacts& facts, const std::filesystem::path& json);

/// What collided, window by window, as numbers.
struct CollisionTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};
CollisionTable collisionTable(std::span<const CollisionWindow> windows);

/// Plots and a table of it for the page; nothing where nothing touches.
void addCollisions(const Measured& measured, ReportInput& in);

/// Replaces DIR/collisions.csv: what collided, window by window. The smallest gap is 0 where nothing was near.
void writeCollisions(const std::filesystem::path& csv, std::span<const CollisionWindow> windows);

/// Replaces DIR/energy.csv: what the cloth holds at the end of each window of the motion, and the works of the window.
void writeEnergy(const std::filesystem::path& csv, std::span<const std::array<double, 11>> rows);

/// Replaces DIR/memory.csv: what each patch remembers, window by window.
void writeMemory(const std::filesystem::path& csv, const MemoryMeasure& memory);

/// What it remembers, and what sticks, for the page.
void addMemory(const Measured& measured, ReportInput& in);

/// Replaces DIR/zones.csv: what each part of the body bears over the motion, all of it, what presses and what rubs, and
/// without belt and edges on springs.
void writeZones(const std::filesystem::path& csv, const ZonesMeasure& zones);

/// Replaces DIR/patches.csv: stress away from free edges and from re-entrant corners, and curvature, of each patch in
/// each frame of the motion; and, where there are straps, DIR/straps.csv: what they carry.
void writeCloth(const std::filesystem::path& dir, const Scenario& scenario, const Measured& measured);

/// Which parts of the body bear the garment, for the page; nothing where nothing touches.
void addZones(const Measured& measured, ReportInput& in);

/// Replaces PREFIX.xml and PREFIX.mot: what the cloth does to the human, as OpenSim's ExternalLoads
/// (analysis/opensim.hpp); PREFIX.osim and PREFIX_motion.mot: the human, and its motion at the times of these
/// (analysis/opensim_model.hpp).
void writeOpenSim(const Scenario& scenario, const Measured& measured, const std::filesystem::path& prefix);

/// The pictures of a run: those of its case, or where that names none one of what is worn, of which there is a film
/// too.
std::vector<PictureCase> picturesOf(const Case& c);

/// As the picture names it; else upright where a human wears the cloth.
PictureSize sizeOf(const Scenario& scenario, const PictureCase& picture);

/// Replaces DIR/pressures.csv: of each part of the body that something presses on, frame by frame of the time that
/// counts, the pressure where it is largest then, and where the mean over time is largest that mean, had the motion
/// ended there (Measured::comfort has the largest of the former and the last of the latter).
void writePressures(const std::filesystem::path& csv, const Scenario& scenario, const Measured& measured);

/// Pressure on the body against comfort limits, for the page; nothing where nothing touches a human.
void addComfort(const Scenario& scenario, const Measured& measured, ReportInput& in);

/// The largest pressure of the motion on the bare body, from two sides, into `folder`; none where nothing touches a
/// human. Throws RunError.
std::vector<Picture> takeBodyPictures(const Scenario& scenario, const Measured& measured,
                                      const std::filesystem::path& folder);

/// One such picture, colours from 0 to `high_Pa`.
void renderBody(const Scenario& scenario, const BodyMap& map, const BodyLoads& loads, double time_s,
                const PictureCase& picture, double high_Pa, const std::filesystem::path& png);

/// Replaces DIR/latitude.csv: pressure and touching area of each body in bands up to the angle from up (seen from the
/// body's origin), and the normal force within, in the last frame.
void writeLatitude(const std::filesystem::path& csv, const std::vector<TouchMeasure>& touch);

/// "swing (80 % of the stride)"; "the lead-in from standing" without a phase.
std::string phaseWords(const Strides& strides, std::optional<double> phase);

/// "swing (80 % of the stride), while the hip flexes against the garment, at 23 degrees of flexion".
std::string causeOf(const JointMeasure& m, const std::optional<Strides>& strides);

/// Whose flexion and the like: what a positive added torque means.
std::string signRule();

/// Holds or fails, with limits.
std::vector<AuditCheck> auditOf(const Measured& measured);

/// What a stretch of the fabric means, and up to where its law holds.
std::string stretchMeaning(const Case& c, std::span<const Stretch> measured);

/// What a reader must know before trusting the numbers.
std::vector<std::string> assumptionsOf(const Scenario& scenario, const Measured& measured);

ReportInput reportInput(const Scenario& scenario, const Measured& measured, const RunFacts& facts,
                        const std::string& identity, const std::vector<Picture>& pictures);

/// The frame nearest to what the picture asks for.
int frameOf(const RecordingReader& recording, const Measured& measured, const PictureCase& picture);

/// "Stress in the fabric at 1.24 s, seen from the front right"; of pressures over which width they are a mean,
/// ComfortCase::sensor_m on the body. `from`: in place of the picture's view.
std::string captionOf(const PictureCase& picture, double time_s, double sensor_m,
                      const std::optional<Viewpoint>& from = {});

}  // namespace gambeson
