#include "cases/input/table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "cases/input/message.hpp"
#include "cases/input/mistakes.hpp"

namespace gambeson::schema {

JsonNode nodeOf(double x) {
  JsonNode n;
  n.type = JsonNode::Type::number;
  n.number = x;
  return n;
}

JsonNode nodeOf(bool b) {
  JsonNode n;
  n.type = JsonNode::Type::boolean;
  n.boolean = b;
  return n;
}

JsonNode nodeOf(const std::string& s) {
  JsonNode n;
  n.type = JsonNode::Type::text;
  n.text = s;
  return n;
}

JsonNode nodeOf(const Vec3& v) {
  JsonNode n = emptyList();
  for (int i = 0; i < 3; ++i) n.children.push_back(nodeOf(v[i]));
  return n;
}

JsonNode nodeOf(const Vec2& v) { return nodeOfList({v.x, v.y}); }

JsonNode nodeOfList(const std::vector<double>& values) {
  JsonNode n = emptyList();
  for (const double v : values) n.children.push_back(nodeOf(v));
  return n;
}

JsonNode emptyList() {
  JsonNode n;
  n.type = JsonNode::Type::list;
  return n;
}

void readItems(const Entry& list, const std::string& of, const std::function<void(const Entry&)>& read) {
  if (list.node.type != JsonNode::Type::list)
    list.fail(fmt::format("expected a list [ ] of {}, not {}", of, describe(list.node)));
  Mistakes mistakes;
  for (std::size_t i = 0; i < list.node.children.size(); ++i) mistakes.without([&] { read(list.item(i)); });
  mistakes.say();
}

Vec2 readPair(const Entry& entry, const std::string& unit, const Range& range) {
  if (entry.node.type != JsonNode::Type::list || entry.node.children.size() != 2)
    entry.fail("expected a list of two numbers [s, t], not " + describe(entry.node));
  const std::vector<double> v = readNumbers(entry, unit, range);
  return {v[0], v[1]};
}

std::vector<double> readNumbers(const Entry& entry, const std::string& unit, const Range& range) {
  if (entry.node.type != JsonNode::Type::list) entry.fail("expected a list of numbers, not " + describe(entry.node));
  std::vector<double> values;
  readItems(entry, "numbers", [&](const Entry& item) { values.push_back(readNumber(item, unit, range)); });
  return values;
}

Vec3 readVector(const Entry& entry, const std::string& unit, const Range& range) {
  if (entry.node.type != JsonNode::Type::list || entry.node.children.size() != 3)
    entry.fail("expected a list of three numbers [x, y, z], not " + describe(entry.node));
  const std::vector<double> v = readNumbers(entry, unit, range);
  return {v[0], v[1], v[2]};
}

Vec3 readDirection(const Entry& entry) {
  const Vec3 v = readVector(entry, "", between(-1e6, 1e6));
  if (!(norm(v) > 1e-6)) entry.fail("a direction cannot have the length 0; allowed: a length above 1e-6");
  return normalized(v);
}

namespace {

std::filesystem::path readName(const Entry& entry) {
  const std::string& text = readText(entry);
  if (text.size() > 4000) entry.fail("this is not the name of a file");
  const bool from_command_line = entry.node.line == 0;
  const std::filesystem::path base =
      from_command_line ? std::filesystem::current_path() : std::filesystem::absolute(entry.file).parent_path();
  const std::filesystem::path path = (base / text).lexically_normal();
  if (const std::string why = unfitText(path.string()); !why.empty()) entry.fail("the folder of the file " + why);
  return path;
}

std::filesystem::path readExisting(const Entry& entry, std::filesystem::file_status& status) {
  std::filesystem::path path = readName(entry);
  std::error_code error;
  status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::none)
    entry.fail(path.string() + " cannot be read: " + error.message());
  if (!std::filesystem::exists(status)) entry.fail("there is no file " + path.string());
  return path;
}

}  // namespace

std::filesystem::path readPath(const Entry& entry) {
  if (entry.recorded) return readName(entry);
  std::filesystem::file_status status;
  std::filesystem::path path = readExisting(entry, status);
  if (!std::filesystem::is_regular_file(status)) entry.fail(path.string() + " is not a file");
  return path;
}

std::filesystem::path readFolder(const Entry& entry) {
  if (entry.recorded) return readName(entry);
  std::filesystem::file_status status;
  std::filesystem::path path = readExisting(entry, status);
  if (!std::filesystem::is_directory(status)) entry.fail(path.string() + " is not a folder");
  return path;
}

}  // namespace gambeson::schema
