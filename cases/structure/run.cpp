#include "cases/structure/run.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "cases/cloth/thread_strains.hpp"
#include "cases/cloth/usual.hpp"
#include "cases/input/message.hpp"
#include "cases/input/overrides.hpp"
#include "cases/input/wrong_entry.hpp"
#include "cases/runs/disk_space.hpp"
#include "cases/runs/progress.hpp"
#include "cases/runs/recorded_case.hpp"
#include "cases/runs/results_folder.hpp"
#include "cases/runs/run_identity.hpp"
#include "cases/runs/stop_message.hpp"
#include "cases/runs/temporary_folder.hpp"
#include "cases/structure/checks.hpp"
#include "cases/structure/fields.hpp"
#include "cases/structure/mover.hpp"
#include "cases/structure/results.hpp"
#include "cases/structure/stretch.hpp"
#include "cases/structure/tallies.hpp"
#include "core/error.hpp"
#include "core/io/csv.hpp"
#include "core/io/own_file.hpp"
#include "core/statics/modal.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson {
namespace {

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Whoever divides by the mass needs one that is positive; densities and thicknesses near zero round to none.
void requireMass(const StructureCase& c, const Structure& s) {
  if (c.kind == StructureKind::statics) return;
  const bool modal = c.kind == StructureKind::modal, explicit_steps = !modal && c.dynamics.stepsPoints();
  StructureSystem system(s, ProgramEnds::constant);
  SymmetricMatrix M = system.sparsity();
  system.mass(modal ? c.modal.lumped_mass : explicit_steps || c.dynamics.lumped_mass, M);
  bool positive = true;
  for (int k = 0; k < M.size; ++k) {
    const double mass = M.values[static_cast<std::size_t>(M.offsets[k])];
    positive = positive && mass > 0 && std::isfinite(1 / mass);
  }
  // Modes and explicit steps need no more; implicit ones take the factor.
  if (positive && !modal && !explicit_steps) positive = SymmetricFactor(M).factorise(M) == Definiteness::positive;
  if (!positive)
    throw InputError({"", 0, "material"},
                     "a control point has no mass to speak of; allowed: a density and a thickness "
                     "that give it one");
}

/// All that is built before anything is solved. Throws InputError with the place in the case's file.
struct BuiltStructure {
  StructureModel model;
  std::optional<Probes> probes;  ///< refer to the model
  PlaceMesh mesh;

  explicit BuiltStructure(const StructureCase& c) {
    try {
      StructureOptions options;
      model = buildModel(c, options);
      requireMass(c, *model.structure);
      addMotion(c, model);
      probes.emplace(c, model, options);
      mesh = model.structure->cloth->placeMesh(c.output.samples_per_cell);
    } catch (const InputError& e) {
      sayInCase(c.file, c.overrides, e);
    }
  }
  BuiltStructure(const BuiltStructure&) = delete;
  BuiltStructure& operator=(const BuiltStructure&) = delete;
};

/// What a run gathers on its way.
class Run {
 public:
  Run(const StructureCase& c, const RunOptions& options) : c_(c), out_(options.out), folder_(out_, inputsOf(c), false) {
    built_.emplace(c);
    stretch_.emplace(c, built_->model, built_->mesh);
    removeEarlierResults(out_);
    RecordingLayout layout;
    layout.identity = RunIdentity(caseIdentity(c), built_->model.structure->cloth->kernels(), DeviceKind::cpu).text();
    layout.metadata = writeCase(c);
    layout.triangles = built_->mesh.triangles;
    layout.body_triangles = obstacleTriangles(built_->model);
    writer_.emplace(RecordingWriter::create(out_, layout));
    writeOwnFile(out_ / "case.json", writeCase(c));
    facts.build_s = since(start_);
  }

  const Structure& structure() const { return *built_->model.structure; }
  const StructureModel& model() const { return built_->model; }

  /// A row of the table: `lead`, then the probes' values.
  void add(const MeasuredState& state, std::vector<double> lead) {
    const std::vector<double> values = built_->probes->values(state);
    lead.insert(lead.end(), values.begin(), values.end());
    path.rows.push_back(std::move(lead));
    last_ = state;
    stretch_->add(state);
    const LawRange range = structure().cloth->lawRange({state.q, {}, state.history});
    if (range.points > 0 && (facts.law_range.points == 0 || range.beyond > facts.law_range.beyond))
      facts.law_range = range;
    if (c_.output.shapes == ShapesKept::all) keep(state);
  }
  void columns(std::vector<std::string> lead) {
    lead.insert(lead.end(), built_->probes->columns().begin(), built_->probes->columns().end());
    path.columns = std::move(lead);
  }
  /// Leaves the rows so far in path.csv, at most once a second: whatever stops the run, they are there.
  void save() {
    if (path.rows.size() == saved_ || (saved_ > 0 && since(saved_at_) < 1)) return;
    writeCsv(out_ / "path.csv", path.columns, path.rows);
    saved_ = path.rows.size();
    saved_at_ = Clock::now();
  }
  /// Says how much so many rows are going to take where that is much: all of them are recorded at the end.
  void foretell(double rows) const {
    constexpr double per_vertex = 14;
    const double shapes = c_.output.shapes == ShapesKept::all ? rows : 1;
    const double bytes = 4 * per_vertex * static_cast<double>(built_->mesh.uv.size()) * shapes +
                         16 * static_cast<double>(path.columns.size()) * rows;
    if (const std::string note = sizeNote(bytes, freeBytes(out_)); !note.empty()) sayNote(note);
  }
  /// A whole shape for ParaView and the pictures.
  void keep(const MeasuredState& state) {
    Frame frame = frameOf(shapeOf(built_->model, built_->mesh, state), frames_++, state.at);
    if (const std::vector<Vec3> x = obstacleVertices(built_->model, state.at); !x.empty()) {
      Field& position = frame.body_fields.emplace_back(Field{"position", "m", 3, {}});
      for (const Vec3& v : x)
        for (int d = 0; d < 3; ++d) position.data.push_back(static_cast<float>(v[d]));
    }
    writer_->append(std::move(frame));
  }

  /// Everything that is left; `failures` of pictures do not stop it.
  void finish() {
    facts.wall_s = since(start_);
    facts.solve_s = facts.wall_s - facts.build_s;
    facts.threads = omp_get_max_threads();
    if (last_.q.empty()) last_ = measureRest();
    const MeshShape shape = shapeOf(built_->model, built_->mesh, last_);
    if (frames_ == 0 && c_.output.shapes != ShapesKept::none) keep(last_);
    if (frames_ > 0) writer_->closeSegment({});
    writeCsv(out_ / "path.csv", path.columns, path.rows);
    writeShapeTable(built_->mesh, shape, out_ / "shape.csv");
    std::vector<AuditCheck> checks = structureChecks(c_, built_->model, path, modes, last_, shape, facts);
    for (AuditCheck& check : stretch_->checks()) checks.push_back(std::move(check));
    writeStructureSummary(c_, built_->model, path, modes, last_, built_->mesh, shape, facts, checks,
                          out_ / "summary.json");
    std::vector<std::string> failures;
    const std::vector<Picture> pictures = takeStructurePictures(c_, out_, out_ / "snapshots", failures);
    writeStructurePage(c_, out_, pictures, out_ / "report.html");
    if (!facts.finished) throw RunError(fmt::format("{}\nWhat converged before is in {}", facts.why, out_.string()));
    if (!checks.front().holds())
      throw RunError(fmt::format("{}\nThe report is in {}", checks.front().wrong, out_.string()));
    for (const AuditCheck& k : checks)
      if (!k.holds()) fmt::print(stderr, "{}\n", messageText("A check fails: " + k.wrong));
    if (!failures.empty())
      throw RunError(failures.front() + " (the numbers and the report are in " + out_.string() + ")");
  }

  StructureFacts facts;
  PathTable path;
  std::vector<ModeRow> modes;

 private:
  MeasuredState measureRest() const {
    MeasuredState state;
    state.q = structure().cloth->rest();
    return state;
  }

  const StructureCase& c_;
  std::filesystem::path out_;
  ResultsFolder folder_;
  Clock::time_point start_ = Clock::now();
  std::optional<BuiltStructure> built_;
  std::optional<StretchTally> stretch_;
  std::optional<RecordingWriter> writer_;
  int frames_ = 0;
  MeasuredState last_;
  std::size_t saved_ = 0;  ///< rows of path.csv
  Clock::time_point saved_at_;
};

/// Runs f; what it throws as a failure of the run is kept for after the results.
template <class F>
void attempt(StructureFacts& facts, F f) {
  try {
    f();
  } catch (const RunError& e) {
    facts.finished = false;
    facts.why = e.what();
  }
}

/// Energy that laws with a memory and the cloth's damping have turned to heat since the start.
constexpr const char* lost_column = "lost_energy_J";

/// The key of the first material whose law is a cell of yarns.
std::string keyOfCell(const StructureCase& c) {
  const auto is_cell = [](const MaterialCase& m) { return m.energy_source && m.energy_source->isCell(); };
  if (is_cell(c.material)) return "material.fabric.law.cell";
  for (std::size_t i = 0; i < c.other_materials.size(); ++i)
    if (is_cell(c.other_materials[i])) return fmt::format("other_materials[{}].fabric.law.cell", i);
  return "material";
}

void solve(const StructureCase& c, const StaticReport& report, StructureFacts& facts) {
  facts.finished = report.reached;
  facts.why = report.why;
  if (!report.reached && report.unanswered.unanswered > 0)
    facts.why = fmt::format("{}: {}. Smaller loads, or more steps, may do", keyOfCell(c), report.why);
  facts.factorisations = report.factorisations;
  facts.unanswered_tries = report.unanswered_tries;
  if (!report.reached && report.unanswered.unanswered > 0) facts.law_range = report.unanswered;
}

void runStatic(const StructureCase& c, Run& run) {
  const Structure& s = run.structure();
  const bool remembers = s.cloth->historySize() > 0;
  std::vector<std::string> lead{"factor", "iterations", "residual",       "negative_pivots",
                                "jumped", "rounded",    "strain_energy_J"};
  if (remembers) lead.push_back(lost_column);
  run.columns(std::move(lead));
  run.foretell(c.statics.steps + 1.0);
  Progress progress(1, 0, stderr, "");
  // The start of every path, so that tables and plots have it.
  const std::vector<double> rest(static_cast<std::size_t>(s.dofs.unknowns()), 0.0);
  const MeasuredState start = measureStatic(s, rest, 0, c.statics.linear);
  std::vector<double> first{0, 0, 0, 0, 0, 0, start.strain_energy_J};
  if (remembers) first.push_back(0);
  run.add(start, std::move(first));
  attempt(run.facts, [&] {
    solve(c,
          solveStatic(s, c.statics,
                      [&](const StaticPoint& p) {
                        const MeasuredState state = measureStatic(s, p.y, p.factor, c.statics.linear, p.history);
                        std::vector<double> row{p.factor,
                                                static_cast<double>(p.iterations),
                                                p.residual,
                                                static_cast<double>(p.negative_pivots),
                                                p.jumped ? 1. : 0.,
                                                p.rounded ? 1. : 0.,
                                                state.strain_energy_J};
                        if (remembers) row.push_back(p.lost_J);
                        run.add(state, std::move(row));
                        if (p.rounded) run.facts.rounded = std::max(run.facts.rounded, p.residual);
                        run.facts.jumps += p.jumped ? 1 : 0;
                        if (c.statics.arc_length && p.jumped) run.facts.jumped_at.push_back(p.factor);
                        if (p.limit_point) run.facts.limit_points.push_back(p.factor);
                        if (p.bifurcation) run.facts.bifurcations.push_back(p.factor);
                        ++run.facts.points;
                        run.facts.iterations += p.iterations;
                        progress.update(std::abs(p.factor), "loading");
                        run.save();
                        return true;
                      }),
          run.facts);
  });
}

void runDynamic(const StructureCase& c, Run& run) {
  std::vector<std::string> lead{"time_s", "kinetic_energy_J", "strain_energy_J", "external_energy_J", "total_energy_J"};
  const Structure& s = run.structure();
  // What implicit schemes lose to the cloth's damping is no row of theirs, as what they lose to Rayleigh's.
  const bool remembers = c.dynamics.stepsPoints() ? s.cloth->losesEnergy() : s.cloth->historySize() > 0;
  if (remembers) lead.push_back(lost_column);
  std::optional<ContactTally> contact;
  if (c.contact) {
    contact.emplace(c);
    run.facts.contact.emplace();
    lead.insert(lead.end(), contact->columns().begin(), contact->columns().end());
  }
  std::optional<ThreadStrains> strains;
  if (c.output.thread_strains) {
    strains.emplace(*s.cloth);
    lead.insert(lead.end(), ThreadStrains::columns().begin(), ThreadStrains::columns().end());
  }
  run.columns(std::move(lead));
  const bool lumped = c.dynamics.lumps();
  const double interval = c.output.interval_s.value_or(c.dynamics.end_s / 100);
  run.foretell(std::ceil(c.dynamics.end_s / interval) + 1);
  Progress progress(c.dynamics.end_s);
  Mover mover(c, run.model());
  State state = mover.start();
  long rows = 0;
  LoadWork work(s);
  double step_s = 0, lost_J = 0;
  double recorded_s = std::numeric_limits<double>::infinity();  // nothing yet
  const auto record = [&](const State& now) {
    recorded_s = now.time_s;
    DynamicEnergy energy = energyOf(s, now, lumped);
    energy.external = -work.work_J(energy);
    std::vector<double> row{now.time_s, energy.kinetic, energy.internal, energy.external, energy.total()};
    if (remembers) row.push_back(lost_J);
    MeasuredState state_now = measureDynamic(run.model(), now, lumped, step_s);
    if (contact) {
      const std::vector<Vec3> held_N = contact->heldForces();
      for (std::size_t k = 0; k < held_N.size(); ++k)
        state_now.reaction_N[static_cast<std::size_t>(run.model().motion->held_points[k])] = held_N[k];
      const std::vector<double> more = contact->row(*run.facts.contact);
      row.insert(row.end(), more.begin(), more.end());
    }
    if (strains) {
      const std::vector<double> more = strains->values(state_now.q);
      row.insert(row.end(), more.begin(), more.end());
    }
    run.add(state_now, std::move(row));
    while (static_cast<double>(rows) * interval <= now.time_s * (1 + 1e-12)) ++rows;
  };
  if (c.output.audit) run.facts.audit.emplace(s, lumped);
  attempt(run.facts, [&] {
    work.follow(state, lumped);
    record(state);
    mover.advance(
        c.dynamics.end_s, state,
        [&](const State& before, const State& now, const StepReport& r, const StepResult& result, const Frequency&) {
          if (contact) contact->observe(r, result, *run.facts.contact);
          work.follow(now, lumped);
          step_s = r.step_s;
          lost_J += r.work.cloth;
          ++run.facts.points;
          run.facts.projections += r.limit.projections;
          run.facts.limits_missed += !r.limit.converged;
          run.facts.limit_residual = std::max(run.facts.limit_residual, r.limit.residual);
          if (now.time_s * (1 + 1e-12) >= static_cast<double>(rows) * interval || now.time_s >= c.dynamics.end_s)
            record(now);
          if (run.facts.audit && run.model().motion) run.facts.audit->observe(before, now, r);
          if (run.facts.audit && !run.model().motion) run.facts.audit->observe(now, r.work.cloth);
          progress.update(now.time_s, "moving");
          run.save();
        });
    run.facts.finished = true;
  });
  if (!run.facts.finished && state.time_s > recorded_s) record(state);  // where it failed
  run.facts.iterations = mover.newton().iterations;
  run.facts.factorisations = mover.newton().factorisations;
}

void runModal(const StructureCase& c, Run& run) {
  run.columns({"mode", "omega_rad_per_s", "frequency_Hz", "residual"});
  const Structure& s = run.structure();
  attempt(run.facts, [&] {
    std::vector<double> y, history;
    double factor = 0;
    run.facts.finished = true;
    if (c.modal.at_equilibrium) {
      solve(c,
            solveStatic(s, c.statics,
                        [&](const StaticPoint& p) {
                          y = p.y;
                          history = p.history;
                          factor = p.factor;
                          ++run.facts.points;
                          run.facts.iterations += p.iterations;
                          return true;
                        }),
            run.facts);
      if (!run.facts.finished) return;
    }
    const std::vector<Mode> modes = naturalModes(s, y, factor, c.modal.count, c.modal.lumped_mass, history);
    Vec3 low = s.cloth->rest()[0], high = s.cloth->rest()[0];
    for (const Vec3& x : s.cloth->rest())
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], x[k]);
        high[k] = std::max(high[k], x[k]);
      }
    for (std::size_t k = 0; k < modes.size(); ++k) {
      MeasuredState state = measureMode(s, y, factor, modes[k].shape, 0.1 * norm(high - low));
      state.at = static_cast<double>(k + 1);
      run.modes.push_back({modes[k].omega_rad_per_s, modes[k].residual, modes[k].rounding});
      run.add(state, {state.at, modes[k].omega_rad_per_s, modes[k].omega_rad_per_s / (2 * std::numbers::pi),
                      modes[k].residual});
      if (c.output.shapes == ShapesKept::last) run.keep(state);
    }
  });
}

}  // namespace

void checkStructure(const StructureCase& c) {
  const BuiltStructure built(c);
  caseIdentity(c);
}

void requireCarried(const StructureCase& c, DeviceKind device) {
  if (device == DeviceKind::cpu) return;
  sayInCase(c.file, c.overrides,
            InputError({"", 0, "kind"}, fmt::format("structures are not carried by --device {}; allowed with it: "
                                                    "\"wear\"; without: --device cpu",
                                                    wordOf(device))));
}

int runStructure(const StructureCase& c, const RunOptions& options) {
  requireCarried(c, options.device);
  if (options.resume)
    throw InputError({"command line", 0, "--resume"},
                     "is not possible for static, dynamic and modal cases: they start from the beginning");
  useThreads(options.threads);
  const std::string kept = c.kind == StructureKind::modal
                               ? ""
                               : fmt::format("; {} has what was done before", (options.out / "path.csv").string());
  const StopMessage stopped("stopped by a signal" + kept +
                            "; a structure starts from the beginning when it is run again");
  const schema::Object& table = schema::structureTable(c.kind);
  const JsonNode node = schema::writeObject(table, &c);
  for (const std::string& unusual : unusualNumbers(table, node)) sayNote(unusual);
  for (const std::string& assumed : assumedThicknesses(node)) sayNote(assumed);
  Run run(c, options);
  if (c.kind == StructureKind::statics)
    runStatic(c, run);
  else if (c.kind == StructureKind::dynamics)
    runDynamic(c, run);
  else
    runModal(c, run);
  run.finish();
  fmt::print("Report: {}\n", (options.out / "report.html").string());
  return 0;
}

bool holdsStructure(const std::filesystem::path& results) {
  if (!std::filesystem::exists(results / "case.json")) return false;
  const JsonNode root = readCaseNode(results / "case.json", {});
  const JsonNode* kind = root.find("kind");
  return kind && kind->text != "wear";
}

namespace {

/// The case of a results folder.
StructureCase recordedStructure(const std::filesystem::path& results) {
  requireRecordedCase(results, readLayout(results));
  return readRecordedStructureCase(caseFile(results));
}

}  // namespace

int renderStructureResults(const RenderOptions& o) {
  const StructureCase c = recordedStructure(o.results);
  if (o.field == PictureField::pressure || o.field == PictureField::body_pressure)
    throw InputError({"command line", 0, "--field"},
                     "there is no contact pressure here; allowed: stress, strain or plain");
  if (o.field == PictureField::set || o.field == PictureField::friction)
    throw InputError({"command line", 0, "--field"},
                     "pictures of structures do not show what their cloth remembers; allowed: stress, strain or plain");
  if (o.field == PictureField::thickness)
    throw InputError({"command line", 0, "--field"},
                     "pictures of structures do not show their thickness; allowed: stress, strain or plain");
  if (o.when == PictureTime::peak)
    throw InputError({"command line", 0, "--time"},
                     "there is no peak here; allowed: end, or a frame's load factor, time or mode");
  const RecordingReader recording(o.results);
  StructurePicture picture;
  picture.field = o.field == PictureField::stress   ? StructureField::automatic
                  : o.field == PictureField::strain ? StructureField::strain
                                                    : StructureField::plain;
  picture.view = o.view;
  picture.width = o.width;
  picture.height = o.height;
  int best = recording.frameCount() - 1;
  if (o.when == PictureTime::at) {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < recording.frameCount(); ++k) {
      const double at = frameValue(recording.frame(k));
      if (std::abs(at - o.time_s) < least) least = std::abs(at - o.time_s), best = k;
    }
  }
  renderStructure(c, recording.layout(), recording.frame(best), picture, o.png);
  return 0;
}

int reportStructureResults(const ReportOptions& o) {
  const StructureCase c = recordedStructure(o.results);
  const TemporaryFolder folder;
  std::vector<std::string> failures;
  const std::vector<Picture> pictures = takeStructurePictures(c, o.results, folder.path(), failures);
  writeStructurePage(c, o.results, pictures, o.html);
  if (!failures.empty()) throw RunError(failures.front() + " (the report is " + o.html.string() + ")");
  return 0;
}

}  // namespace gambeson
