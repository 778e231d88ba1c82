#pragma once
/// A step of velocity Verlet with contact (core/motion/step.cpp) on a device: the state stays there from step to step.

#include <map>
#include <memory>
#include <optional>

#include "core/error.hpp"
#include "core/motion/contradict.hpp"
#include "gpu/forces/shell_forces.hpp"
#include "gpu/near/near_finder.hpp"
#include "gpu/near/skin_on.hpp"
#include "gpu/step/device_frequency.hpp"
#include "gpu/step/step_impacts.hpp"
#include "gpu/step/step_kernels.hpp"
#include "gpu/step/step_output.hpp"
#include "gpu/step/step_solve.hpp"
#include "gpu/step/tree_sum.hpp"

namespace gambeson::gpu {

template <class Device>
class DeviceStep final : public StepOnDevice {
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  using Queue = typename Device::Queue;
  using Solve = StepSolve<Device>;

 public:
  DeviceStep(const Model& model, const State& start, const StageWork& stage, double room)
      : m_(model),
        n_(model.freeCount()),
        samples_(model.surface.size()),
        forces_(dynamic_cast<const NurbsShell&>(*model.cloth), {}),
        near_({model.collisions, model.obstacles, model.bulges}, nearStart(model, start, stage),
              partOf(roomForNear(model.collisions), room)),
        queue_(near_.queue()),
        WT_(queue_, model.surface.WT),
        WTt_(queue_, model.surface.WTt),
        inverse_mass_(uploaded<Device>(queue_, model.inverse_mass)),
        density_(uploaded<Device>(queue_, model.density_kg_per_m2)),
        layer_(uploaded<Device>(queue_, model.layer_m)),
        cell_(uploaded<Device>(queue_, model.cell_m)),
        mass_(uploaded<Device>(queue_, model.mass_kg)),
        net_(uploaded<Device>(queue_, model.net)),
        spring_triangle_(uploaded<Device>(queue_, springTriangles(model))),
        facts_(1),
        counts_(1),
        row_count_(1),
        solve_(queue_, model, WT_, WTt_, inverse_mass_, density_),
        motion_sum_(n_),
        outputs_(n_, !model.held_points.empty()) {
    forces_.setLoads(pointLoads(model));
    for (Buffer<Point4>* of_points :
         {&position_, &velocity_, &acceleration_, &pressed_, &pressed_next_, &predictor_, &solved_})
      *of_points = Buffer<Point4>(static_cast<std::size_t>(n_));
    jerk_ = Buffer<Point4>(static_cast<std::size_t>(n_));
    net_jerk_ = Buffer<Point4>(static_cast<std::size_t>(forces_.points()));
    sample_sum_ = Buffer<Point4>(static_cast<std::size_t>(samples_));
    of_sample_ = Buffer<int>(static_cast<std::size_t>(samples_)),
    sample_begin_ = Buffer<int>(static_cast<std::size_t>(samples_));
    sample_scan_.emplace(samples_);
    makeRows();
    makeImpacts(room);
  }

  long repeats() const override { return near_.repeats() + solve_.repeats() + (impacts_ ? impacts_->repeats() : 0); }

  void set(const State& s) override {
    forces_.setFree(s.p);
    const auto up = [&](const std::vector<Vec3>& from, Buffer<Point4>& to) {
      std::vector<Point4> all(static_cast<std::size_t>(n_));
      for (std::size_t i = 0; i < from.size(); ++i) all[i] = point4(from[i]);
      queue_.upload(std::span<const Point4>(all), to);
    };
    up(s.v, velocity_);
    up(s.a, acceleration_);
    up(s.pressed, pressed_);
    queue_.forEach(n_, CopyPoints{forces_.arrays().free_position, position_.data()});
    forces_.setHistory(s.history, 0);
    std::vector<WarmEntry> warm;
    for (const WarmContact& c : s.warm)
      warm.push_back(
          {{static_cast<int>(c.kind), c.sample, c.obstacle, c.feature}, {c.traction, c.mean_Pa, c.slip_m_per_s}});
    near_.warm().set(queue_, warm, 0);
    near_.forget();
    goes_on_ = false;
    made_ = false;
  }

  void accept() override {
    if (!made_) return;
    made_ = false;
    const ForceArrays f = forces_.arrays();
    queue_.forEach(n_, TakeOver{f.free_position, f.velocity, f.acceleration, pressed_next_.data(), position_.data(),
                                velocity_.data(), acceleration_.data(), pressed_.data()});
    forces_.commitHistory(queue_);
    near_.warm().keep(queue_, near_.lists().facts(), near_.warm().borne());
    goes_on_ = true;
  }

  void complete(State& s) override {
    s.warm.clear();
    for (const WarmEntry& e : near_.warm().kept(queue_))
      s.warm.push_back({static_cast<ContactKind>(e.key.kind), e.key.sample, e.key.obstacle, e.key.feature,
                        e.start.traction, e.start.mean_Pa, e.start.slip_m_per_s});
    if (m_.cloth->historySize() > 0) s.history = forces_.committedHistory();
  }

  Frequency frequency(StandsAt at, std::span<const Vec3> p, std::vector<Vec3>& mode, int iterations) override {
    if (!frequency_) frequency_.emplace(queue_, m_, forces_);
    const Point4* const here = at == StandsAt::start ? position_.data()
                               : at == StandsAt::end ? forces_.arrays().free_position
                                                     : nullptr;
    return frequency_->at(queue_, here, p, mode, iterations);
  }

  StepDone make(const DeviceStepInput& in) override {
    StepDone done;
    const bool rebuild = steps_++ % kRebuild == 0;
    begin(in);
    run(in, rebuild, done);
    if (done.by_cpu == ByCpu::none) leave(done);
    return done;
  }

 private:
  /// What a step is given from.
  enum class From { near, solve, impacts };

  /// What it starts from.
  void begin(const DeviceStepInput& in) {
    queue_.zero(facts_);
    if (made_) {  // the last step was not accepted: forces stand at its end
      queue_.forEach(n_, CopyPoints{position_.data(), forces_.arrays().free_position});
      made_ = false;
    }
    queue_.forEach(n_, Predict{{position_.data(), velocity_.data(), acceleration_.data(), pressed_.data()},
                               0.5 * in.step_s,
                               predictor_.data(),
                               facts_.data()});
    near_.setBodies({in.start, in.end, none_, none_}, in.step_s, goes_on_);
    goes_on_ = false;
    for (const BodyShape& shape : in.shapes) placeShape(shape);
    near_.warm().setScale(queue_, in.last_step_s > 0 ? in.step_s / in.last_step_s : 0);
    placeEllipsoids(in);
    forces_.setAnchors(queue_, in.anchors);
    output_ = outputs_.next();
  }

  /// What is near, velocities with which nothing passes through anything, and the end of the step. All of it is given
  /// at once, as if nothing were to be done twice, and waited for once; what was given too early is given again.
  void run(const DeviceStepInput& in, bool rebuild, StepDone& done) {
    const double dt = in.step_s;
    From from = From::near;
    for (int round = 1;;) {
      give(in, from, rebuild && round == 1);
      const StepCounts now = queue_.download(counts_, 1)[0];
      addTimes(from, done.times);
      if (from == From::near) {
        NearSizes sizes;
        std::copy_n(now.near, sizes.size(), sizes.begin());
        if (!near_.took(sizes)) continue;
        done.contacts = static_cast<int>(sizes[kContacts]);
        done.cloth_contacts = now.step.cloth_contacts;
        done.smallest_gap_m = now.step.smallest_gap_m();
        if (now.step.not_finite > 0) return void(done.leftTo(ByCpu::not_finite));
        if (now.step.inside > 0) return void(done.leftTo(ByCpu::inside));
      }
      if (now.rows > near_.lists().facts().room) {
        near_.makeRoom(now.rows);
        from = From::near, round = 1;
        continue;
      }
      if (from != From::impacts) {
        from = From::solve;
        if (!solve_.took(now.solve)) continue;
        done.contact = Solve::report(now.solve);
        from = From::impacts;
      }
      if (contradict(done.contact, dt)) return void(done.leftTo(ByCpu::unsolved));
      ImpactCounts hits;
      if (impacts_ && !impacts_->took(now.impacts, hits)) continue;
      if (round == 1) done.impacts = static_cast<int>(hits.all());
      done.impact_rounds = round - 1;
      if (hits.all() == 0) return take(now.step, done);
      if (round > kRounds) return void(done.leftTo(ByCpu::impacts));
      impacts_->addRows(rows(), {dt, keptPart(dt), round++});
      from = From::solve;
    }
  }
  void give(const DeviceStepInput& in, From from, bool rebuild) {
    const double dt = in.step_s;
    laps_.start(queue_);
    if (from == From::near) {
      findNear(dt, rebuild);
      startRows(dt);
    }
    laps_.lap(queue_);
    if (from != From::impacts) solve_.give(rows(), dt, predictor_, solved_);
    laps_.lap(queue_);
    findImpacts(dt, rebuild);
    laps_.lap(queue_);
    moveOn(in, dt);
    queue_.forEach(std::max(int{kNearLists}, int{kImpactCounts}),
                   CollectCounts{facts_.data(), solve_.facts().data(), row_count_.data(), near_.lists().counts(),
                                 impacts_ ? impacts_->counts() : nullptr, counts_.data()});
    laps_.lap(queue_);
  }
  void addTimes(From from, PhaseTimes& to) {
    const std::vector<double>& s = laps_.seconds();
    if (from == From::near) to.proximity += s[0];
    if (from != From::impacts) to.contact += s[1];
    to.impact += s[2];
    to.force += s[3];
  }

  void findNear(double dt, bool rebuild) {
    queue_.forEach(samples_, PlaceSamples{WT_.view(), position_.data(), predictor_.data(), dt, near_.mesh().x0.data(),
                                          near_.mesh().x1.data()});
    near_.start(rebuild);
    queue_.forEach(1, ForgetSeen{facts_.data()});
    queue_.forEach(samples_, LookAtSamples{near_.feet().inside(), facts_.data()});
    queue_.forItems(near_.lists().facts(), LookAtContacts{near_.lists().stencils(), layer_.data(), facts_.data()});
  }

  static constexpr int kRounds = 8;    ///< of solves, as in core
  static constexpr int kRebuild = 16;  ///< steps between trees that are built anew

  template <class Sizes>
  static Sizes partOf(Sizes sizes, double part) {
    for (Count& n : sizes) n = std::max<Count>(16, static_cast<Count>(part * static_cast<double>(n)));
    return sizes;
  }
  static NearStep nearStart(const Model& m, const State& s, const StageWork& w) {
    static thread_local std::vector<Vec3> x;
    x.resize(m.surface.size());
    m.surface.WT.multiply<Vec3>(s.p, x);
    return {x, x, 1, {w.start.obstacles, w.start.obstacles, w.start.vertices, w.start.vertices}};
  }

  /// Of a body that deforms, its vertices at both ends.
  void placeShape(const BodyShape& shape) {
    const CollisionModel::Body& body = m_.collisions.bodies[m_.collisions.body_of_obstacle[shape.obstacle]];
    const auto first = static_cast<std::size_t>(body.first_vertex);
    Buffer<Vec3>&x0 = near_.mesh().x0, &x1 = near_.mesh().x1;
    if (!shape.skin) {
      queue_.uploadLater(std::span<const Vec3>(shape.start), x0, first);
      queue_.uploadLater(std::span<const Vec3>(shape.end), x1, first);
      return;
    }
    std::unique_ptr<SkinOn<Device>>& skin = skins_[shape.skin];
    if (!skin) skin = std::make_unique<SkinOn<Device>>(*shape.skin, 2);
    skin->bend(queue_, shape.poses, 2);
    const int n = static_cast<int>(body.local.size());
    queue_.forEach(n, PlaceSkin{skin->data(), n, x0.data() + first, x1.data() + first});
  }
  static std::vector<std::array<int, 3>> springTriangles(const Model& m) {
    std::vector<std::array<int, 3>> all;
    for (const SpringSupportPoint& s : m.springs) {
      all.push_back({-1, -1, -1});
      if (s.obstacle < 0) continue;
      const int first = m.collisions.bodies[m.collisions.body_of_obstacle[s.obstacle]].first_vertex;
      for (int k = 0; k < 3; ++k) all.back()[k] = first + s.triangle[k];
    }
    return all;
  }

  /// Arrays beside those of the contacts.
  void makeRows() {
    const auto room = static_cast<std::size_t>(near_.lists().facts().room);
    if (terms_.size() == room) return;
    terms_ = Buffer<RowTerms>(room);
    traction_ = Buffer<Vec3>(room), impulse_ = Buffer<Vec3>(room);
    share_ = Buffer<double>(room);
    active_ = Buffer<int>(room), active_place_ = Buffer<int>(room);
    part_place_ = Buffer<int>(5 * room), part_ = Buffer<int>(5 * room);
    row_scan_.emplace(static_cast<int>(room));
  }
  StepRows rows() {
    const List<ContactFacts> facts = near_.lists().facts();
    return {facts.items,      near_.lists().stencils(), near_.lists().touches(), terms_.data(),
            traction_.data(), impulse_.data(),          row_count_.data(),       facts.room};
  }
  int room() { return static_cast<int>(near_.lists().facts().room); }

  void startRows(double dt) {
    makeRows();
    const List<ContactFacts> facts = near_.lists().facts();
    queue_.forEach(1, CopyCount{facts.count, row_count_.data()});
    queue_.forItems(facts, SetTerms{rows(), near_.warm().started(), density_.data(), dt, keptPart(dt),
                                    m_.contact.compliance_m_per_Pa, m_.collisions.untangling.speed_mps});
  }

  double keptPart(double dt) const { return -std::expm1(-dt / m_.contact.relaxation_s); }

  void makeImpacts(double room) {
    if (!m_.collisions.self && m_.obstacles.empty()) return;
    const Buffer<Vec3>& x0 = near_.mesh().x0;
    impacts_.emplace(queue_, m_, queue_.download(x0, x0.size()), partOf(roomForImpacts(m_.collisions), room));
    for (std::size_t o = 0; o < m_.obstacles.size(); ++o)
      if (const auto* e = std::get_if<Ellipsoid>(&m_.obstacles[o].shape)) {
        ellipsoids_.emplace_back();
        ellipsoids_.back().metric = ellipsoidMetric(*e);
        ellipsoids_.back().obstacle = static_cast<int>(o);
      }
    ellipsoid_ = Buffer<EllipsoidBody>(ellipsoids_.size());
  }
  void placeEllipsoids(const DeviceStepInput& in) {
    for (EllipsoidBody& e : ellipsoids_) {
      e.start = in.start[static_cast<std::size_t>(e.obstacle)];
      e.end = in.end[static_cast<std::size_t>(e.obstacle)];
    }
    if (!ellipsoids_.empty()) queue_.uploadLater(std::span<const EllipsoidBody>(ellipsoids_), ellipsoid_);
  }
  /// With the velocities that were solved for.
  void findImpacts(double dt, bool rebuild) {
    Vec3 *const x0 = near_.mesh().x0.data(), *const x1 = near_.mesh().x1.data();
    queue_.forEach(samples_, MoveSamples{WT_.view(), solved_.data(), dt, x0, x1});
    if (impacts_)
      impacts_->start({x0, x1, near_.feet().inside(), ellipsoid_.data()}, rebuild ? Trees::rebuilt : Trees::refitted);
  }

  /// Positions, what lasts, forces and velocities at the end.
  void moveOn(const DeviceStepInput& in, double dt) {
    const ForceArrays f = forces_.arrays();
    queue_.forEach(1, ForgetEnd{facts_.data()});
    queue_.forEach(n_, MovePoints{position_.data(), solved_.data(), dt, f.free_position, facts_.data()});
    queue_.forEach(samples_, LookAtWays{near_.mesh().x0.data(), near_.mesh().x1.data(), cell_.data(), facts_.data()});
    const StepRows all = rows();
    queue_.forEach(room(), LookAtRows{all, near_.lists().facts().count, density_.data(), dt, keptPart(dt),
                                      near_.warm().borne(), share_.data(), active_.data(), facts_.data()});
    queue_.zero(of_sample_);
    queue_.forEachOf(all, CountParts{all, share_.data(), of_sample_.data(), part_place_.data()});
    sample_scan_->run(queue_, of_sample_, sample_begin_);
    queue_.forEachOf(all, PlaceParts{all, share_.data(), sample_begin_.data(), part_place_.data(), part_.data()});
    queue_.forEach(samples_, AddParts{all, share_.data(), sample_begin_.data(), of_sample_.data(), part_.data(),
                                      sample_sum_.data()});
    queue_.forEach(n_, PressPoints{WTt_.view(), sample_sum_.data(), inverse_mass_.data(), dt, 0.5 * dt, solved_.data(),
                                   pressed_next_.data(), f.velocity});
    queue_.forEach(static_cast<int>(spring_triangle_.size()),
                   SpringNormals{spring_triangle_.data(), near_.mesh().x1.data(), forces_.springNormals()});
    forces_.setElapsed(dt);
    forces_.placePoints(queue_);
    forces_.give(queue_);
    forces_.freeForces(queue_);
    forces_.accelerate(queue_, in.air, 0.5 * dt);
    made_ = true;
    const MotionSum* motion = motion_sum_.run(
        queue_, n_,
        MotionOfPoint{mass_.data(), position_.data(), f.free_position, acceleration_.data(), f.acceleration});
    queue_.forEach(1, TakeSum{motion, facts_.data()});
    queue_.forEach(n_, Jerk{acceleration_.data(), f.acceleration, jerk_.data()});
    queue_.forEach(static_cast<int>(net_.size()),
                   LookAtJerk{net_.data(), forces_.mapped(queue_, jerk_, net_jerk_), facts_.data()});
    queue_.forEach(n_,
                   GatherPoints{solved_.data(), f.acceleration, pressed_next_.data(),
                                m_.held_points.empty() ? nullptr : f.free_force, n_, output_->points(), facts_.data()});
    row_scan_->run(queue_, active_, active_place_);
    gatherRows();
  }

  /// What the control must know of the end.
  void take(const StepFacts& now, StepDone& done) {
    if (now.lost > 0) return void(done.leftTo(ByCpu::not_finite));
    active_count_ = static_cast<std::size_t>(now.active);
    done.presses = now.pressing > 0;
    done.largest_way = now.way();
    done.shown_frequency2 = now.motion.way2 > 0 ? std::sqrt(now.motion.force2 / now.motion.way2) : 0;
    done.most_jerk_per_s4 = now.mostJerk();
  }
  /// What the ledger must, later.
  void leave(StepDone& done) {
    if (static_cast<int>(active_count_) > output_->room()) {
      output_->makeRoom(2 * active_count_);
      gatherRows();
    }
    output_->send(copies_, queue_, active_count_);
    done.arrays = std::move(output_);
  }
  void gatherRows() {
    queue_.forEachOf(rows(),
                     GatherRows{rows(), active_.data(), active_place_.data(), output_->rows(), output_->room()});
  }

  const Model& m_;
  int n_, samples_;
  ShellForces<Device> forces_;
  NearFinder<Device> near_;
  Queue& queue_;
  SlicedRows<Device> WT_, WTt_;
  Buffer<double> inverse_mass_, density_, layer_, cell_, mass_;
  Buffer<NetEdge> net_;
  Buffer<std::array<int, 3>> spring_triangle_;
  std::map<const Skin*, std::unique_ptr<SkinOn<Device>>> skins_;
  const DeformedVertices none_;
  // The state, and what the step makes of it beside the arrays of forces_.
  Buffer<Point4> position_, velocity_, acceleration_, pressed_, pressed_next_, predictor_, solved_;
  bool made_ = false;     ///< a step stands in the arrays of forces_ that is not accepted yet
  bool goes_on_ = false;  ///< the next pass begins where the last one ended
  long steps_ = 0;
  // Rows.
  Buffer<StepFacts> facts_;
  Buffer<StepCounts> counts_;
  Buffer<Count> row_count_;
  Solve solve_;
  Buffer<RowTerms> terms_;
  Buffer<Vec3> traction_, impulse_;
  Buffer<double> share_;
  Buffer<int> active_, active_place_, part_place_, part_, of_sample_, sample_begin_;
  std::optional<typename Device::ExclusiveSum> row_scan_, sample_scan_;
  Buffer<Point4> sample_sum_, jerk_, net_jerk_;
  TreeSum<Device, MotionSum> motion_sum_;
  StepOutputs<Device> outputs_;
  std::shared_ptr<StepOutput<Device>> output_;  ///< of the step that is being made
  std::size_t active_count_ = 0;                ///< rows of it that carry something
  Queue copies_;
  typename Device::Laps laps_;
  std::optional<StepImpacts<Device>> impacts_;  ///< where there is anything to touch
  std::vector<EllipsoidBody> ellipsoids_;
  Buffer<EllipsoidBody> ellipsoid_;
  std::optional<DeviceFrequency<Device>> frequency_;  ///< once it was asked for
};

}  // namespace gambeson::gpu
