#include "core/io/xdmf.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/io/csv.hpp"

namespace gambeson {
namespace {

std::string escaped(const std::string& text) {
  std::string s;
  for (const char c : text) {
    if (c == '&') {
      s += "&amp;";
    } else if (c == '<') {
      s += "&lt;";
    } else if (c == '"') {
      s += "&quot;";
    } else {
      s += c;
    }
  }
  return s;
}

const char* attributeType(int components) {
  switch (components) {
    case 1:
      return "Scalar";
    case 3:
      return "Vector";
    case 6:
      return "Tensor6";
    case 9:
      return "Tensor";
    default:
      return "Matrix";
  }
}

std::string heavy(const char* type, int precision, std::size_t rows, int columns, const std::string& file,
                  const std::string& path) {
  return fmt::format(R"(<DataItem Format="HDF" NumberType="{}" Precision="{}" Dimensions="{}{}">{}:{}</DataItem>)",
                     type, precision, rows, columns == 1 ? "" : fmt::format(" {}", columns), file, path);
}

std::string attribute(const FieldInfo& field, std::size_t rows, const std::string& file, const std::string& path) {
  return fmt::format(
      "<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">"
      "<Information Name=\"unit\" Value=\"{}\"/>{}</Attribute>\n",
      escaped(field.name), attributeType(field.components), escaped(field.unit),
      heavy("Float", 4, rows, field.components, file, path));
}

std::string surface(std::size_t triangles, const FrameInfo& info, int frame, const std::string& file) {
  std::string s = "<Grid Name=\"surface\" GridType=\"Uniform\">\n";
  s += fmt::format("<Topology TopologyType=\"Triangle\" NumberOfElements=\"{}\">{}</Topology>\n", triangles,
                   heavy("Int", 4, triangles, 3, "frames/layout.h5", "/triangles"));
  s += fmt::format("<Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
                   heavy("Float", 4, info.samples, 3, file, framePath(frame) + "/positions"));
  for (const auto& field : info.sample_fields) s += attribute(field, info.samples, file, samplePath(frame, field.name));
  return s + "</Grid>\n";
}

std::string controlPoints(const FrameInfo& info, int frame, const std::string& file) {
  std::string s = "<Grid Name=\"control_points\" GridType=\"Uniform\">\n";
  s +=
      fmt::format("<Topology TopologyType=\"Polyvertex\" NodesPerElement=\"1\" NumberOfElements=\"{}\">{}</Topology>\n",
                  info.controls, heavy("Int", 4, info.controls, 1, file, framePath(frame) + "/vertices"));
  s += fmt::format("<Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
                   heavy("Float", 4, info.controls, 3, file, controlPath(frame, "position")));
  for (const auto& field : info.control_fields)
    if (field.name != "position") s += attribute(field, info.controls, file, controlPath(frame, field.name));
  return s + "</Grid>\n";
}

std::string body(std::size_t triangles, const FrameInfo& info, int frame, const std::string& file) {
  std::string s = "<Grid Name=\"body\" GridType=\"Uniform\">\n";
  s += fmt::format("<Topology TopologyType=\"Triangle\" NumberOfElements=\"{}\">{}</Topology>\n", triangles,
                   heavy("Int", 4, triangles, 3, "frames/layout.h5", "/body_triangles"));
  s += fmt::format("<Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
                   heavy("Float", 4, info.body, 3, file, bodyPath(frame, "position")));
  for (const auto& field : info.body_fields)
    if (field.name != "position") s += attribute(field, info.body, file, bodyPath(frame, field.name));
  return s + "</Grid>\n";
}

}  // namespace

std::string xdmfSidecar(std::size_t triangles, std::size_t body_triangles, const std::vector<FrameInfo>& infos,
                        const std::vector<int>& segment_ends) {
  std::string s = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n";
  s += "<Grid Name=\"recording\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  int segment = 0;
  for (int frame = 0; frame < static_cast<int>(infos.size()); ++frame) {
    while (frame >= segment_ends[static_cast<std::size_t>(segment)]) ++segment;
    const FrameInfo& info = infos[static_cast<std::size_t>(frame)];
    const std::string file = "frames/" + segmentPath("", segment).filename().string();
    const bool points =
        info.controls > 0 && std::any_of(info.control_fields.begin(), info.control_fields.end(),
                                         [](const auto& f) { return f.name == "position" && f.components == 3; });
    s += "<Grid Name=\"frame\" GridType=\"Collection\" CollectionType=\"Spatial\">\n";
    s += "<Time Value=\"" + shortest(info.time_s) + "\"/>\n";
    s += surface(triangles, info, frame, file);
    if (points) s += controlPoints(info, frame, file);
    if (body_triangles > 0 && info.body > 0) s += body(body_triangles, info, frame, file);
    s += "</Grid>\n";
  }
  return s + "</Grid>\n</Domain>\n</Xdmf>\n";
}

}  // namespace gambeson
