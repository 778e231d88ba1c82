#include "core/motion/model.hpp"

#include <algorithm>
#include <cmath>

#include "core/cloth/shell/evened_masses.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// The shorter side of the cell that (u, v) is in, measured through the cell's middle: a cell whose edge is a point
/// has one too.
double cellSide(const NurbsPatch& patch, const Vec2& at) {
  const int i = findSpan(patch.u, at.x), j = findSpan(patch.v, at.y);
  const double u0 = patch.u.knots[i], u1 = patch.u.knots[i + 1], v0 = patch.v.knots[j], v1 = patch.v.knots[j + 1];
  const double u = 0.5 * (u0 + u1), v = 0.5 * (v0 + v1);
  const auto x = [&](double a, double b) { return surfaceDerivatives(patch, a, b)[0]; };
  return std::min(norm(x(u1, v) - x(u0, v)), norm(x(u, v1) - x(u, v0)));
}

/// See Model::spring_rise_m.
std::vector<Vec3> springRise(const Garment& garment, const Model& m) {
  std::vector<double> mass(garment.patches.size(), 0), stiffness(mass.size(), 0);  // by layer, of which there are fewer
  const std::vector<int> first = controlOffsets(garment);
  const std::vector<double> control_mass = controlMasses(garment);
  for (std::size_t p = 0; p < garment.patches.size(); ++p)
    for (int c = first[p]; c < first[p + 1]; ++c) mass[garment.layerOf(static_cast<int>(p))] += control_mass[c];
  const auto layer = [&](const SpringSupportPoint& s) { return garment.layerOf(m.surface.patch[s.sample]); };
  for (const SpringSupportPoint& s : m.springs) stiffness[layer(s)] += s.stiffness_N_per_m;
  std::vector<Vec3> rise;
  for (const SpringSupportPoint& s : m.springs)
    rise.push_back(stiffness[layer(s)] > 0 ? (-mass[layer(s)] / stiffness[layer(s)]) * m.environment.gravity_m_per_s2
                                           : Vec3{});
  return rise;
}

}  // namespace

std::unique_ptr<Model> buildModel(const Garment& garment, const ModelOptions& options, const Environment& environment,
                                  const ContactParameters& contact, std::vector<Obstacle> obstacles) {
  const KernelSet& kernels = options.kernels ? *options.kernels : widestKernels();
  FreeMap map = buildFreeMap(garment);
  if (!garment.layer.empty() && garment.layer.size() != garment.patches.size())
    throw InputError({"", 0, "layer"}, "one number for each patch is needed");
  validateFields(garment);
  std::vector<int> per_cell = options.patch_samples_per_cell;
  if (per_cell.empty()) per_cell.assign(garment.patches.size(), options.samples_per_cell);
  Surface surface = buildSurface(garment, map, per_cell);
  Bulges bulges = buildBulges(garment, surface, per_cell);
  const int n = map.T.column_count;
  std::vector<double> control_area = controlAreas(garment), area(n), mass(n), inverse(n);
  map.Tt.multiply<double>(control_area, area);
  constexpr double kLeastShare = 0.25;  // of the untrimmed mass, where threads pull
  const bool threads = options.strain_limit.mode != LimitMode::none;
  map.Tt.multiply<double>(threads ? evenedMasses(garment, kLeastShare) : controlMasses(garment), mass);
  std::vector<char> held(n, 0);
  for (int c : options.held_control_points)
    for (int k = map.T.offsets[c]; k < map.T.offsets[c + 1]; ++k) held[map.T.columns[k]] = 1;
  for (int i = 0; i < n; ++i) {
    if (!(mass[i] > 0)) throw InputError({"", 0, "garment"}, "a control point would carry no mass");
    inverse[i] = held[i] ? 0 : 1 / mass[i];
  }
  Shell shell(garment, kernels, options.gauss_extra, options.cell_rule);
  auto model = std::unique_ptr<Model>(new Model{std::move(shell),
                                                std::move(map),
                                                std::move(surface),
                                                std::move(mass),
                                                std::move(inverse),
                                                std::move(area),
                                                std::move(held),
                                                {},
                                                {},
                                                {},
                                                {},
                                                environment,
                                                contact,
                                                std::move(obstacles),
                                                nullptr,
                                                {},
                                                options.springs,
                                                options.anchor_count,
                                                {},
                                                {},
                                                options.strain_limit,
                                                {},
                                                netEdges(garment),
                                                options.stitches,
                                                std::move(bulges),
                                                {}});
  for (int i = 0; i < n; ++i)
    if (model->held[i]) model->held_points.push_back(i);
  std::vector<int> layer;
  for (int s = 0; s < model->surface.size(); ++s) {
    const int patch = model->surface.patch[s];
    const Fabric fabric = fabricAt(garment, patch, model->surface.parameters[s]);
    model->cell_m.push_back(cellSide(garment.patches[patch], model->surface.parameters[s]));
    model->density_kg_per_m2.push_back(fabric.surfaceDensity());
    model->layer_m.push_back(contact.layer_m > 0 ? contact.layer_m : fabric.thickness());
    layer.push_back(garment.layerOf(patch));
  }
  for (double a : model->area_m2) model->drag_kg_per_s.push_back(environment.drag_kg_per_m2s * a);
  addStitchDamping(model->stitches, model->surface.WT, model->drag_kg_per_s);
  model->spring_rise_m = springRise(garment, *model);
  if (!options.dead_force_N.empty()) {
    if (static_cast<int>(options.dead_force_N.size()) != model->shell.controlCount())
      throw InputError({"", 0, "loads"}, "dead forces need one entry per control point");
    model->dead_force_N.resize(n);
    model->map.Tt.multiply<Vec3>(options.dead_force_N, model->dead_force_N);
  }
  if (threads) {
    checkLimit(options.strain_limit);
    model->strain_rows = buildStrainRows(garment, model->map, {model->inverse_mass, {}}, options.strain_limit.points);
  }
  model->proximity = std::make_unique<ProximityQuery>(model->obstacles);
  std::vector<Vec3> Q, rest(model->surface.size());
  for (const NurbsPatch& p : garment.patches) Q.insert(Q.end(), p.points.begin(), p.points.end());
  model->surface.W.multiply<Vec3>(Q, rest);
  const std::vector<Placement> placement(model->obstacles.size());
  model->collisions = buildCollisions(model->surface, rest, std::move(layer), model->layer_m, model->obstacles,
                                      placement, options.self_contact);
  return model;
}

}  // namespace gambeson
