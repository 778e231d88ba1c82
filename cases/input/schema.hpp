#pragma once
/// The field table's parts: what a field is, and how objects of a case file are read, written and described by it.
/// Nothing here knows which fields there are (cases/wear/case/fields.hpp does).

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/input/json.hpp"

namespace gambeson::schema {

/// Allowed values of a number. NaN is in no range.
struct Range {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;

  bool contains(double x) const { return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high); }
  /// "> 0 and <= 0.05 m", "any"
  std::string text(const std::string& unit = "") const;
};
inline Range any() { return {}; }
inline Range above(double low) { return {.low = low, .low_open = true}; }
inline Range atLeast(double low) { return {.low = low}; }
inline Range between(double low, double high) { return {.low = low, .high = high}; }
inline Range aboveTo(double low, double high) { return {.low = low, .high = high, .low_open = true}; }

/// What stands under a key or in a list of a file, and the way to complain about it.
struct Entry {
  const JsonNode& node;
  std::string path;         ///< "supports[0].springs.stiffness"
  const std::string& file;  ///< of the case
  bool recorded = false;    ///< whether it is of a finished run: files that it names may be gone

  /// Throws InputError: file, line and key; "command line" where the value came from there.
  [[noreturn]] void fail(const std::string& reason) const;
  /// The same, at the member `key` where it is written, here where it is not.
  [[noreturn]] void failAt(const std::string& key, const std::string& reason) const;
  Entry member(const JsonNode& child) const;
  Entry item(std::size_t index) const;
};

struct Object;

/// pair: [s, t]; numbers: a list of numbers; lists: a list of such lists; map: an object whose keys are names of the
/// user's own, with lists in them; number_or_object: one number in place of an object; word_or_object: likewise one of
/// `choices`; any: whatever the meaning says.
enum class Kind {
  number,
  integer,
  boolean,
  text,
  path,
  choice,
  pair,
  vector,
  numbers,
  lists,
  map,
  object,
  number_or_object,
  word_or_object,
  list,
  text_list,
  any
};

/// One row of the table.
struct Field {
  std::string key;
  Kind kind = Kind::number;
  std::string unit;  ///< SI; "" for plain numbers
  Range range;
  std::vector<std::string> choices;  ///< words; also for numbers and vectors that allow a word in their place
  std::string doc;
  bool required = false;
  std::string alternatives;               ///< fields that name the same ones exclude each other
  std::optional<JsonNode> default_value;  ///< what reading gives where the field is absent
  std::string default_note;               ///< says where a default comes from that is not a plain value
  std::shared_ptr<const Object> object;   ///< of an object, or of the items of a list

  std::function<void(const Entry&, void*)> read;
  std::function<std::optional<JsonNode>(const void*)> write;  ///< nothing where the field is absent
};

/// Fields that exclude each other.
struct Alternatives {
  std::string name;
  bool required = false;
};

/// An object of a case file.
struct Object {
  std::string title;  ///< for the documentation
  std::string about;  ///< of a whole file: what it is, without a full stop
  std::vector<Field> fields;
  std::vector<Alternatives> alternatives;
  /// Rules between fields, run after all fields are read.
  std::function<void(const Entry&, void*)> check;

  const Field* find(std::string_view key) const;
};

/// Reads all fields into `target`, which holds the defaults. Unknown keys, missing fields and broken rules throw
/// InputError.
void readObject(const Object& object, const Entry& entry, void* target);
JsonNode writeObject(const Object& object, const void* source);

/// Values of single fields; throw InputError.
double readNumber(const Entry& entry, const std::string& unit, const Range& range);
int readInteger(const Entry& entry, const Range& range);
bool readBoolean(const Entry& entry);
const std::string& readText(const Entry& entry);
std::size_t readChoice(const Entry& entry, const std::vector<std::string>& choices);

/// The closest of `words` to `wrong`, or "" where none is close.
std::string closest(std::string_view wrong, const std::vector<std::string>& words);
/// "a, b or c"
std::string joined(const std::vector<std::string>& words);

/// JSON as text, indented by two; numbers as short as they can be read back exactly.
std::string toText(const JsonNode& node);
/// JSON Schema (draft 2020-12) of an object.
std::string jsonSchema(const Object& root);
/// Of a file that is one of several kinds, told apart by the key "kind"; the first kind is that of files without it.
struct KindOfFile {
  std::string kind;
  const Object* root;
};
std::string jsonSchema(const std::vector<KindOfFile>& kinds);
/// The fields as Markdown, one table per object.
std::string markdown(const Object& root);
/// The same for several kinds; objects that read alike in two kinds are written once.
std::string markdown(const std::vector<KindOfFile>& kinds);
/// An object and all below it, as a chapter of its own in the same page.
std::string chapter(const std::string& title, const Object& root);

}  // namespace gambeson::schema
