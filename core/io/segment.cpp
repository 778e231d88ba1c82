#include "core/io/segment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <numeric>

namespace gambeson {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLayoutFormat = "gambeson recording layout";
constexpr const char* kSegmentFormat = "gambeson recording segment";
constexpr std::int64_t kLayoutVersion = 2;  ///< 1 had no scene
constexpr std::int64_t kSegmentVersion = 1;

/// Runs `read` and turns what the file's content can provoke into an InputError that names the file.
template <class F>
auto reading(const fs::path& path, F&& read) -> decltype(read()) {
  try {
    return read();
  } catch (const hdf5::Error& e) {
    throw InputError(at(path), std::string("damaged file of a recording: ") + e.what());
  } catch (const std::bad_alloc&) {
    throw InputError(at(path), "damaged file of a recording: impossible sizes");
  } catch (const std::length_error&) {
    throw InputError(at(path), "damaged file of a recording: impossible sizes");
  }
}

hdf5::File openFile(const fs::path& path) {
  if (!fs::exists(path)) throw InputError(at(path), "this file of the recording is missing");
  return reading(path, [&] { return hdf5::File(path); });
}

void requireFormat(const hdf5::File& file, const fs::path& path, const char* format, std::int64_t known) {
  if (file.textAttribute("/", "format") != format) throw hdf5::Error(std::string("not a ") + format);
  if (const auto version = file.intAttribute("/", "version"); version != known)
    throw InputError(at(path), fmt::format("is of a recording in format {}, and this program reads format {}: run its "
                                           "case again, or read it with the program that made it",
                                           version, known));
}

std::size_t highestCorner(const std::vector<std::array<int, 3>>& triangles) {
  int highest = -1;
  for (const auto& t : triangles) highest = std::max({highest, t[0], t[1], t[2]});
  return static_cast<std::size_t>(highest + 1);
}

std::size_t highestSample(const RecordingLayout& layout) { return highestCorner(layout.triangles); }

bool holds(const hdf5::File& file, const std::string& group, const std::string& name) {
  const auto names = file.names(group);
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string numbered(std::size_t k) { return fmt::format("{:06}", k); }

std::size_t rowsOf(const Field& field) {
  if (field.components < 1 || field.data.size() % static_cast<std::size_t>(field.components) != 0)
    throw std::logic_error("field " + field.name + " has a broken last row");
  return field.data.size() / static_cast<std::size_t>(field.components);
}

}  // namespace

fs::path layoutPath(const fs::path& directory) { return directory / "frames" / "layout.h5"; }
fs::path segmentPath(const fs::path& directory, int index) {
  return directory / "frames" / fmt::format("segment_{:06}.h5", index);
}
std::string framePath(int frame) { return fmt::format("/frames/{:06}", frame); }
std::string samplePath(int frame, const std::string& field) {
  return framePath(frame) + "/samples/" + hdf5::linkName(field);
}
std::string controlPath(int frame, const std::string& field) {
  return framePath(frame) + "/controls/" + hdf5::linkName(field);
}

std::string bodyPath(int frame, const std::string& field) {
  return framePath(frame) + "/body/" + hdf5::linkName(field);
}

std::string layoutImage(const RecordingLayout& layout) {
  hdf5::Builder file;
  file.attribute("/", "format", kLayoutFormat);
  file.attribute("/", "version", kLayoutVersion);
  file.texts("/identity", {layout.identity});
  file.texts("/metadata", {layout.metadata});
  const auto put = [&](const char* name, const std::vector<std::array<int, 3>>& triangles) {
    std::vector<int> corners;
    for (const auto& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
    file.array(name, corners, 3);
  };
  put("/triangles", layout.triangles);
  if (!layout.body_triangles.empty()) put("/body_triangles", layout.body_triangles);
  file.group("/tables");
  for (const auto& [table, columns] : layout.tables) file.texts("/tables/" + hdf5::linkName(table), columns);
  if (!layout.patches.empty()) file.group("/patches");
  for (std::size_t p = 0; p < layout.patches.size(); ++p) {
    const PatchLayout& patch = layout.patches[p];
    const std::string at = "/patches/" + numbered(p);
    file.group(at);
    file.attribute(at, "name", patch.name);
    file.attribute(at, "degree_u", patch.degree_u);
    file.attribute(at, "degree_v", patch.degree_v);
    file.array(at + "/knots_u", patch.knots_u);
    file.array(at + "/knots_v", patch.knots_v);
    file.array(at + "/weights", patch.weights);
    file.group(at + "/curves");
    for (std::size_t c = 0; c < patch.trims.size(); ++c) {
      const PatchLayout::Curve& curve = patch.trims[c];
      const std::string of = at + "/curves/" + numbered(c);
      file.group(of);
      file.attribute(of, "degree", curve.degree);
      file.attribute(of, "loop", curve.loop);
      file.array(of + "/knots", curve.knots);
      file.array(of + "/points", curve.points, 2);
      file.array(of + "/weights", curve.weights);
    }
  }
  file.group("/scene");
  for (const auto& [name, values] : layout.scene) {
    const std::string of = "/scene/" + hdf5::linkName(name);
    file.group(of);
    if (!values.reals.empty()) file.array(of + "/reals", values.reals);
    if (!values.integers.empty()) file.array(of + "/integers", values.integers);
    if (!values.texts.empty()) file.texts(of + "/texts", values.texts);
  }
  return file.finish();
}

RecordingLayout readLayout(const fs::path& directory) {
  const fs::path path = layoutPath(directory);
  if (!fs::exists(path)) throw InputError(at(directory), "holds no recording (frames/layout.h5 is missing)");
  return layoutIn(path);
}

RecordingLayout layoutIn(const fs::path& path) {
  const hdf5::File file = openFile(path);
  return reading(path, [&] {
    requireFormat(file, path, kLayoutFormat, kLayoutVersion);
    const auto one = [&](const std::string& name) {
      const auto texts = file.texts(name);
      if (texts.size() != 1) throw hdf5::Error(name + ": not one text");
      return texts[0];
    };
    RecordingLayout layout;
    layout.identity = one("/identity");
    layout.metadata = one("/metadata");
    const auto triangles = [&](const std::string& name, std::vector<std::array<int, 3>>& to) {
      const auto corners = file.ints(name);
      if (corners.columns != 3) throw hdf5::Error(name + ": not three columns");
      for (std::size_t i = 0; i < corners.rows; ++i) {
        const int* c = corners.values.data() + 3 * i;
        if (std::min({c[0], c[1], c[2]}) < 0) throw hdf5::Error(name + ": a negative sample");
        to.push_back({c[0], c[1], c[2]});
      }
    };
    triangles("/triangles", layout.triangles);
    if (holds(file, "/", "body_triangles")) triangles("/body_triangles", layout.body_triangles);
    for (const auto& name : file.names("/tables"))
      layout.tables[hdf5::fromLinkName(name)] = file.texts("/tables/" + name);
    if (holds(file, "/", "patches"))
      for (const auto& p : file.names("/patches")) {
        const std::string of = "/patches/" + p;
        PatchLayout patch{file.textAttribute(of, "name"),
                          static_cast<int>(file.intAttribute(of, "degree_u")),
                          static_cast<int>(file.intAttribute(of, "degree_v")),
                          file.doubles(of + "/knots_u").values,
                          file.doubles(of + "/knots_v").values,
                          file.doubles(of + "/weights").values,
                          {}};
        for (const auto& c : file.names(of + "/curves")) {
          const std::string curve = of + "/curves/" + c;
          patch.trims.push_back({static_cast<int>(file.intAttribute(curve, "loop")),
                                 static_cast<int>(file.intAttribute(curve, "degree")),
                                 file.doubles(curve + "/knots").values, file.doubles(curve + "/points").values,
                                 file.doubles(curve + "/weights").values});
        }
        layout.patches.push_back(std::move(patch));
      }
    for (const auto& name : file.names("/scene")) {
      const std::string of = "/scene/" + name;
      Values& values = layout.scene[hdf5::fromLinkName(name)];
      for (const auto& kind : file.names(of)) {
        if (kind == "reals") values.reals = file.doubles(of + "/reals").values;
        if (kind == "integers") values.integers = file.longs(of + "/integers").values;
        if (kind == "texts") values.texts = file.texts(of + "/texts");
      }
    }
    return layout;
  });
}

SegmentBuilder::SegmentBuilder(const RecordingLayout& layout, int index, int first_frame)
    : layout_(&layout), first_frame_(first_frame) {
  file_.attribute("/", "format", kSegmentFormat);
  file_.attribute("/", "version", kSegmentVersion);
  file_.texts("/identity", {layout.identity});
  file_.attribute("/", "index", index);
  file_.attribute("/", "first_frame", first_frame);
  file_.group("/frames");
  file_.group("/tables");
}

FrameInfo SegmentBuilder::add(const Frame& frame) {
  FrameInfo info;
  info.time_s = frame.time_s;
  info.samples = frame.positions.size() / 3;
  if (frame.positions.size() != 3 * info.samples) throw std::logic_error("positions need 3 values per sample");
  if (info.samples < highestSample(*layout_)) throw std::logic_error("a triangle refers to a sample that is not there");
  for (const Field& field : frame.sample_fields)
    if (rowsOf(field) != info.samples) throw std::logic_error("field " + field.name + " needs one row per sample");
  if (!frame.control_fields.empty()) info.controls = rowsOf(frame.control_fields[0]);
  for (const Field& field : frame.control_fields)
    if (rowsOf(field) != info.controls)
      throw std::logic_error("field " + field.name + " needs one row per control point");

  if (!frame.body_fields.empty()) info.body = rowsOf(frame.body_fields[0]);
  if (info.body < highestCorner(layout_->body_triangles))
    throw std::logic_error("a triangle of the body refers to a vertex that is not there");
  for (const Field& field : frame.body_fields)
    if (rowsOf(field) != info.body)
      throw std::logic_error("field " + field.name + " needs one row per vertex of the body");

  const int index = first_frame_ + static_cast<int>(times_.size());
  const auto put = [&](const std::string& path, const Field& field) {
    file_.array(path, field.data, static_cast<std::size_t>(field.components));
    file_.attribute(path, "unit", field.unit);
  };
  file_.group(framePath(index));
  file_.group(framePath(index) + "/samples");
  file_.group(framePath(index) + "/controls");
  file_.array(framePath(index) + "/positions", frame.positions, 3);
  for (const Field& field : frame.sample_fields) {
    put(samplePath(index, field.name), field);
    info.sample_fields.push_back({field.name, field.unit, field.components});
  }
  std::vector<int> vertices(info.controls);  // one cell per control point, for ParaView
  std::iota(vertices.begin(), vertices.end(), 0);
  file_.array(framePath(index) + "/vertices", vertices);
  for (const Field& field : frame.control_fields) {
    put(controlPath(index, field.name), field);
    info.control_fields.push_back({field.name, field.unit, field.components});
  }
  if (!frame.body_fields.empty()) file_.group(framePath(index) + "/body");
  for (const Field& field : frame.body_fields) {
    put(bodyPath(index, field.name), field);
    info.body_fields.push_back({field.name, field.unit, field.components});
  }
  times_.push_back(frame.time_s);
  return info;
}

void SegmentBuilder::add(const TableRow& row) {
  const auto table = layout_->tables.find(row.table);
  if (table == layout_->tables.end()) throw std::logic_error("the recording has no table " + row.table);
  if (row.values.size() != table->second.size() || row.values.empty())
    throw std::logic_error("a row of " + row.table + " needs one value per column");
  auto& values = rows_[row.table];
  values.insert(values.end(), row.values.begin(), row.values.end());
}

std::string SegmentBuilder::finish(const Checkpoint& checkpoint) {
  file_.array("/times", times_);
  for (const auto& [table, values] : rows_)
    file_.array("/tables/" + hdf5::linkName(table), values, layout_->tables.at(table).size());
  file_.group("/checkpoint");
  file_.array("/checkpoint/time", std::span<const double>(&checkpoint.time_s, 1));
  file_.group("/checkpoint/reals");
  for (const auto& [name, values] : checkpoint.reals) file_.array("/checkpoint/reals/" + hdf5::linkName(name), values);
  file_.group("/checkpoint/integers");
  for (const auto& [name, values] : checkpoint.integers)
    file_.array("/checkpoint/integers/" + hdf5::linkName(name), values);
  return file_.finish();
}

SegmentReader::SegmentReader(const fs::path& directory, const RecordingLayout& layout, int index, int first_frame)
    : path_(segmentPath(directory, index)), layout_(&layout), file_(openFile(path_)), first_frame_(first_frame) {
  reading(path_, [&] {
    requireFormat(file_, path_, kSegmentFormat, kSegmentVersion);
    if (const auto identity = file_.texts("/identity"); identity.size() != 1 || identity[0] != layout.identity)
      throw hdf5::Error("it belongs to another recording");
    if (file_.intAttribute("/", "index") != index || file_.intAttribute("/", "first_frame") != first_frame)
      throw hdf5::Error("it belongs to another place in the recording");
    times_ = file_.doubles("/times").values;
    const auto frames = file_.names("/frames");
    if (frames.size() != times_.size()) throw hdf5::Error("frames and times differ in number");
  });
}

Frame SegmentReader::frame(int index) const {
  return reading(path_, [&] {
    Frame frame;
    frame.time_s = times_.at(static_cast<std::size_t>(index - first_frame_));
    auto positions = file_.floats(framePath(index) + "/positions");
    if (positions.columns != 3 || positions.rows < highestSample(*layout_)) throw hdf5::Error("positions: wrong size");
    frame.positions = std::move(positions.values);
    const auto fields = [&](const std::string& group, std::vector<Field>& to) {
      for (const auto& name : file_.names(group)) {
        auto array = file_.floats(group + "/" + name);
        to.push_back({hdf5::fromLinkName(name), file_.textAttribute(group + "/" + name, "unit"),
                      static_cast<int>(array.columns), std::move(array.values)});
        if (array.rows != (&to == &frame.sample_fields ? positions.rows : rowsOf(to.front())))
          throw hdf5::Error(name + ": wrong size");
      }
    };
    fields(framePath(index) + "/samples", frame.sample_fields);
    fields(framePath(index) + "/controls", frame.control_fields);
    if (holds(file_, framePath(index), "body")) fields(framePath(index) + "/body", frame.body_fields);
    if (!frame.body_fields.empty() && rowsOf(frame.body_fields[0]) < highestCorner(layout_->body_triangles))
      throw hdf5::Error("body: wrong size");
    return frame;
  });
}

Field SegmentReader::sampleField(int index, const std::string& name) const {
  return reading(path_, [&] {
    const std::string group = framePath(index) + "/samples", path = samplePath(index, name);
    if (!holds(file_, group, hdf5::linkName(name))) throw RunError("the recording has no field \"" + name + "\"");
    auto array = file_.floats(path);
    if (array.rows != file_.shape(framePath(index) + "/positions").first) throw hdf5::Error(name + ": wrong size");
    return Field{name, file_.textAttribute(path, "unit"), static_cast<int>(array.columns), std::move(array.values)};
  });
}

FrameInfo SegmentReader::info(int index) const {
  return reading(path_, [&] {
    FrameInfo info;
    info.time_s = times_.at(static_cast<std::size_t>(index - first_frame_));
    info.samples = file_.shape(framePath(index) + "/positions").first;
    const auto fields = [&](const std::string& group, std::vector<FieldInfo>& to, std::size_t* rows) {
      for (const auto& name : file_.names(group)) {
        const auto shape = file_.shape(group + "/" + name);
        to.push_back({hdf5::fromLinkName(name), file_.textAttribute(group + "/" + name, "unit"),
                      static_cast<int>(shape.second)});
        if (rows) *rows = shape.first;
      }
    };
    fields(framePath(index) + "/samples", info.sample_fields, nullptr);
    fields(framePath(index) + "/controls", info.control_fields, &info.controls);
    if (holds(file_, framePath(index), "body")) fields(framePath(index) + "/body", info.body_fields, &info.body);
    return info;
  });
}

void SegmentReader::appendRows(TableRows& rows) const {
  reading(path_, [&] {
    for (const auto& name : file_.names("/tables")) {
      const std::string table = hdf5::fromLinkName(name);
      const auto array = file_.doubles("/tables/" + name);
      const auto columns = layout_->tables.find(table);
      if (columns == layout_->tables.end() || columns->second.size() != array.columns)
        throw hdf5::Error("table " + table + ": not of this recording");
      for (std::size_t i = 0; i < array.rows; ++i) {
        const auto first = array.values.begin() + static_cast<std::ptrdiff_t>(i * array.columns);
        rows[table].emplace_back(first, first + static_cast<std::ptrdiff_t>(array.columns));
      }
    }
  });
}

Checkpoint SegmentReader::checkpoint() const {
  return reading(path_, [&] {
    Checkpoint checkpoint;
    const auto time = file_.doubles("/checkpoint/time").values;
    if (time.size() != 1) throw hdf5::Error("/checkpoint/time: not one number");
    checkpoint.time_s = time[0];
    for (const auto& name : file_.names("/checkpoint/reals"))
      checkpoint.reals[hdf5::fromLinkName(name)] = file_.doubles("/checkpoint/reals/" + name).values;
    for (const auto& name : file_.names("/checkpoint/integers"))
      checkpoint.integers[hdf5::fromLinkName(name)] = file_.longs("/checkpoint/integers/" + name).values;
    return checkpoint;
  });
}

}  // namespace gambeson
