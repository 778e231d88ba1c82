#pragma once
/// JSON in which every value and key knows its line, for messages that point at the place.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace gambeson {

/// A value with its place. Members keep the order of the file.
struct JsonNode {
  enum class Type { null, boolean, number, text, list, object };
  Type type = Type::null;
  /// Line of the value (of its key where it is a member), from 1; 0 for values of the command line.
  int line = 0;
  bool boolean = false;
  double number = 0;
  bool is_integer = false;  ///< the number was written without fraction and exponent
  std::string text;
  std::string key;  ///< name of a member of an object
  /// Where it was read, where that is another file than its root's (a study's value within a case); else null.
  std::shared_ptr<const std::string> file;
  std::vector<JsonNode> children;  ///< members of an object, items of a list

  /// The member called `name`, or null.
  const JsonNode* find(std::string_view name) const;
  JsonNode* find(std::string_view name);
};

/// "an object", "a list", "the text "abc"", "the number 3" ...
std::string describe(const JsonNode& node);

/// What a case file may be at most: more is a mistake (a mesh named in place of the case, say).
struct JsonLimits {
  std::size_t bytes = 1 << 20;
  int depth = 32;
  /// Values of all depths. The node of one takes 136 bytes and room to grow, so that a file of two bytes a value
  /// ("0,0,0") would need a hundred times its size: this keeps any file below half a gigabyte.
  std::size_t values = 2'000'000;
};

/// Throws InputError with line and key: syntax, duplicate keys, numbers out of the range of double, NaN and Infinity
/// literals, invalid UTF-8, more than the limits. `file` is only for messages.
JsonNode parseJson(std::string_view text, const std::string& file, const JsonLimits& limits = {});

/// Reads and parses a file; throws InputError where it is missing, not a regular file, unreadable, empty or too large.
JsonNode readJson(const std::filesystem::path& file, const JsonLimits& limits = {});

/// Sets the value at `path` ("supports[0].springs.stiffness") in `root`, adding objects on the way where they are
/// missing; an index may be one past the end of its list. `value` is JSON where it parses as such, text otherwise.
/// Throws InputError
/// ("command line", path) where the path is malformed or runs into something else than an object or a list.
void overrideValue(JsonNode& root, const std::string& path, const std::string& value);

/// The same with a value of another file, which keeps its lines and knows its file: messages about it point there, and
/// so do those about the path, at the value's line.
void overrideValue(JsonNode& root, const std::string& path, const JsonNode& value, const std::string& file);

}  // namespace gambeson
