#pragma once
/// The part of a page in which a run is looked at from all sides, played and coloured: its data, as the scripts beside
/// this file read them. A page holds them whole and asks the network for nothing.
///
/// The data of a run are a JSON object (`script.viewer-run`) and bytes, deflated and in base64: those that the first
/// picture takes, together (`script.viewer-first`), of which the object names pieces by [begin, length], and blocks
/// (`script.viewer-block`), which it names by their numbers (data-block). Between them a script says that the first are
/// read. Numbers of several bytes have the lowest first.
///   times_s, origin_m    of each frame; positions are about the origin, which follows the wearer
///   start                time, frame, field and view of the first picture; start of a mesh or field: piece of that
///                        frame alone
///   up                   opposite to gravity
///   error_mm             how far a vertex that moves is from where it was recorded, at most
///   meshes               kind: cloth, body, thing; vertices; triangles: piece of int32, each the change from the one
///                        before; parts: names; part: block of uint16, of each vertex
///       moving           block as packed.hpp says, of three components; quantum_m
///       fixed            piece of float32: vertices in the mesh's frame; placed: piece of float32, 12 of each frame:
///                        rows of rotation and origin, about the frame's origin
///   fields               on: cloth or body, over the vertices of its meshes in turn; block as packed.hpp says, of one
///                        component; frames: as many as the run has, or one; scale, step: of values (packed.hpp);
///                        least, most: of all; high: where colours end at first; limits: mesh (-1: any), part (-1:
///                        any), value, text; bare: 0 has the plain colour
///   arrows               block of float32: of each arrow its tip about the frame's origin [m] and its force [N];
///                        counts: of each frame; most_N, longest_m: the longest and how long it is drawn

#include <array>
#include <span>
#include <string>
#include <vector>

#include "analysis/animation/scene.hpp"

namespace gambeson {

/// Where the range ends that a fabric or a wearer is meant for.
struct ViewerLimit {
  int mesh = -1, part = -1;  ///< of the meshes that the field is on; of its parts; -1: any
  double value = 0;          ///< in the field's unit
  std::string text;          ///< "limit of the vest's fabric"
};

struct ViewerField {
  std::string name, title, unit;  ///< "stress", "Stress: largest pull", "N/m"
  bool on_body = false, bare = false;
  double high = 0;
  std::vector<ViewerLimit> limits;
};

struct ViewerArrow {
  Vec3 tip, force_N;
};

/// A run as a page holds it. Meshes first, then fields over them.
class ViewerRun {
 public:
  /// `label` tells it from others of the page; empty where it is alone.
  ViewerRun(std::string title, std::string label, std::vector<double> times_s, std::vector<Vec3> origin_m, Vec3 up);

  enum class Kind { cloth, body, thing };
  /// What is shown first; to be said before what is added.
  void startAt(double time_s, const std::string& field, const std::string& view);
  /// Vertices that move one by one.
  void addMoving(Kind kind, const MovingMesh& mesh, const std::vector<std::string>& parts = {},
                 const std::vector<int>& part_of_vertex = {});
  /// A mesh that moves as a whole; `at` in the world, of each frame.
  void addFixed(Kind kind, const FixedMesh& mesh, const std::vector<Placement>& at,
                const std::vector<std::string>& parts = {}, const std::vector<int>& part_of_vertex = {});
  /// Of each frame, or a single one, over the vertices of its kind's meshes in turn. Fields without any value other
  /// than 0 are left out.
  void addField(const ViewerField& field, std::span<const std::vector<float>> values);
  void addArrows(std::span<const std::vector<ViewerArrow>> of_frames, double most_N, double longest_m,
                 const std::string& legend);

  double error_m() const { return error_m_; }
  /// The scripts that hold what the first picture takes, and the others; `number`: of the run in its page.
  std::string firstHtml(std::size_t number) const;
  std::string restHtml(std::size_t number) const;

 private:
  struct Mesh {
    Kind kind;
    std::string json;
    std::size_t vertices;
    std::vector<int> parents;
  };
  void addMesh(Kind kind, const std::string& name, std::size_t vertices,
               const std::vector<std::array<int, 3>>& triangles, const Color& color,
               const std::vector<std::string>& parts, const std::vector<int>& part_of_vertex, std::string more);
  int block(const std::string& deflated_bytes);
  using Piece = std::array<std::size_t, 2>;  ///< where it begins, and its length [bytes]
  Piece firstPiece(const std::string& bytes);

  std::string title_, label_;
  std::vector<double> times_s_;
  std::vector<Vec3> origin_m_;
  Vec3 up_;
  std::vector<Mesh> meshes_;
  std::string first_;                ///< what the first picture takes
  std::vector<std::string> blocks_;  ///< in base64
  std::vector<std::string> fields_;
  std::string arrows_, start_field_, start_view_ = "front_right";
  std::size_t start_frame_ = 0;
  double error_m_ = 0;
};

/// The section of the page with its scripts: hidden until these find what they need. Libraries are deflated; their
/// notice is readable. Empty without runs.
std::string viewerSection(std::span<const ViewerRun> runs);
/// What a page with a viewer has in its style.
std::string viewerStyle();

}  // namespace gambeson
