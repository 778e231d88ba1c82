#include "cases/input/json.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <unordered_set>
#include <utility>

#include "core/error.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::json;

/// Walks over the text and counts lines. The line of a token is that of the last character read that is not white
/// space: the lexer looks one character past a number, which may be the line's end.
struct LineCount {
  int line = 1;
  int token_line = 1;
};

class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, LineCount* count) : at_(at), count_(count) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    if (*at_ == '\n') {
      ++count_->line;
    } else if (*at_ != ' ' && *at_ != '\t' && *at_ != '\r') {
      count_->token_line = count_->line;
    }
    ++at_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const CountingIterator& b) const { return at_ == b.at_; }
  bool operator!=(const CountingIterator& b) const { return at_ != b.at_; }

 private:
  const char* at_;
  LineCount* count_;
};

/// nlohmann's message without its prefix "[json.exception.parse_error.101] parse error at line 3, column 5: ".
std::string reasonOf(const std::string& what) {
  std::size_t start = what.find("] ");
  start = start == std::string::npos ? 0 : start + 2;
  const std::size_t column = what.find("column ", start);
  if (column != std::string::npos) {
    const std::size_t colon = what.find(": ", column);
    if (colon != std::string::npos) start = colon + 2;
  }
  return what.substr(start);
}

/// Builds the tree from nlohmann's events. Not recursive, so that depth costs no stack.
class TreeBuilder {
 public:
  TreeBuilder(std::string file, const LineCount& count, const JsonLimits& limits)
      : file_(std::move(file)), count_(count), limits_(limits) {}

  JsonNode root;

  bool null() {
    add(JsonNode::Type::null);
    return true;
  }
  bool boolean(bool b) {
    add(JsonNode::Type::boolean).boolean = b;
    return true;
  }
  bool number_integer(Json::number_integer_t n) { return number(static_cast<double>(n), true); }
  bool number_unsigned(Json::number_unsigned_t n) { return number(static_cast<double>(n), true); }
  bool number_float(Json::number_float_t x, const std::string&) { return number(x, false); }
  bool string(std::string& s) {
    add(JsonNode::Type::text).text = std::move(s);
    return true;
  }
  bool binary(Json::binary_t&) { return false; }
  bool start_object(std::size_t) { return open(JsonNode::Type::object); }
  bool end_object() { return close(); }
  bool start_array(std::size_t) { return open(JsonNode::Type::list); }
  bool end_array() { return close(); }
  bool key(std::string& name) {
    key_line_ = count_.token_line;
    key_ = std::move(name);
    if (!keys_.back().insert(key_).second) {
      const int first = open_.back()->find(key_)->line;
      throw InputError({file_, key_line_, path(key_)}, fmt::format("written twice, first in line {}", first));
    }
    return true;
  }
  bool parse_error(std::size_t, const std::string& token, const nlohmann::detail::exception& e) {
    std::string reason = reasonOf(e.what());
    if (token.find("<U+0000>") != std::string::npos) reason = "this is not a text file";
    if (reason.starts_with("number overflow")) reason = "the number is too large; allowed: at most 1.8e308";
    if (reason.find("UTF-8") != std::string::npos) reason = "this is not UTF-8 text";
    throw InputError({file_, count_.token_line, path(key_)}, reason);
  }

 private:
  /// The keys that lead to the current place, with `last` at the end.
  std::string path(const std::string& last) const {
    std::string p;
    for (std::size_t i = 1; i < open_.size(); ++i) {
      if (open_[i - 1]->type == JsonNode::Type::list)
        p += fmt::format("[{}]", open_[i - 1]->children.size() - 1);
      else
        p += (p.empty() ? "" : ".") + open_[i]->key;
    }
    if (!last.empty()) p += (p.empty() ? "" : ".") + last;
    return p;
  }

  JsonNode& add(JsonNode::Type type) {
    if (++values_ > limits_.values)
      throw InputError({file_, count_.token_line, ""},
                       fmt::format("more than {} values; at most so many are read", limits_.values));
    JsonNode* node = &root;
    if (!open_.empty()) {
      node = &open_.back()->children.emplace_back();
      if (open_.back()->type == JsonNode::Type::object) node->key = std::exchange(key_, {});
    }
    node->type = type;
    node->line = node->key.empty() ? count_.token_line : key_line_;
    return *node;
  }
  bool number(double x, bool is_integer) {
    JsonNode& node = add(JsonNode::Type::number);
    node.number = x;
    node.is_integer = is_integer;
    return true;
  }
  bool open(JsonNode::Type type) {
    if (static_cast<int>(open_.size()) >= limits_.depth)
      throw InputError({file_, count_.token_line, ""}, fmt::format("nested deeper than {} levels", limits_.depth));
    open_.push_back(&add(type));
    keys_.emplace_back();
    return true;
  }
  bool close() {
    open_.pop_back();
    keys_.pop_back();
    return true;
  }

  std::string file_;
  const LineCount& count_;
  const JsonLimits& limits_;
  std::size_t values_ = 0;  ///< nodes made
  std::string key_;
  int key_line_ = 0;
  std::vector<JsonNode*> open_;  ///< a node's address holds while it is open: only its own children grow
  std::vector<std::unordered_set<std::string>> keys_;
};

}  // namespace

const JsonNode* JsonNode::find(std::string_view name) const {
  for (const JsonNode& c : children)
    if (c.key == name) return &c;
  return nullptr;
}

JsonNode* JsonNode::find(std::string_view name) {
  return const_cast<JsonNode*>(static_cast<const JsonNode&>(*this).find(name));
}

std::string describe(const JsonNode& node) {
  switch (node.type) {
    case JsonNode::Type::null:
      return "null";
    case JsonNode::Type::boolean:
      return node.boolean ? "true" : "false";
    case JsonNode::Type::number:
      return fmt::format("the number {}", node.number);
    case JsonNode::Type::text:
      return node.text.size() <= 60 ? fmt::format("\"{}\"", node.text)
                                    : fmt::format("\"{}...\"", node.text.substr(0, 60));
    case JsonNode::Type::list:
      return fmt::format("a list of {}", node.children.size());
    case JsonNode::Type::object:
      return "an object { }";
  }
  return "";
}

JsonNode parseJson(std::string_view text, const std::string& file, const JsonLimits& limits) {
  if (text.size() > limits.bytes)
    throw InputError({file, 0, ""}, fmt::format("{} bytes; at most {} are read", text.size(), limits.bytes));
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) throw InputError({file, 0, ""}, "the file is empty");
  LineCount count;
  TreeBuilder builder(file, count, limits);
  const CountingIterator begin(text.data(), &count), end(text.data() + text.size(), &count);
  Json::sax_parse(begin, end, &builder);
  return std::move(builder.root);
}

JsonNode readJson(const std::filesystem::path& file, const JsonLimits& limits) {
  const InputError::Where where{file.string(), 0, ""};
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::none) throw InputError(where, "cannot be read: " + error.message());
  if (!std::filesystem::exists(status)) throw InputError(where, "there is no such file");
  if (std::filesystem::is_directory(status)) throw InputError(where, "this is a folder, not a file");
  if (!std::filesystem::is_regular_file(status)) throw InputError(where, "this is not a regular file");
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw InputError(where, "cannot be read: " + error.message());
  if (size > limits.bytes) throw InputError(where, fmt::format("{} bytes; at most {} are read", size, limits.bytes));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(where, "cannot be opened; check its permissions");
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size) throw InputError(where, "cannot be read to its end");
  return parseJson(text, file.string(), limits);
}

namespace {

constexpr const char* command_line = "command line";

/// Line 0 for all of a tree, so that messages do not point into the file.
void forgetLines(JsonNode& node) {
  node.line = 0;
  for (JsonNode& c : node.children) forgetLines(c);
}

struct Step {
  std::string key;  ///< empty: an index
  std::size_t index = 0;
};

/// `where` is for messages.
std::vector<Step> splitPath(const std::string& path, const InputError::Where& where) {
  const InputError malformed(where, "this is not a path of a field; write for example output.pictures[0].time");
  std::vector<Step> steps;
  std::size_t at = 0;
  while (at < path.size()) {
    if (path[at] == '[') {
      const std::size_t close = path.find(']', at);
      const std::string digits = close == std::string::npos ? "" : path.substr(at + 1, close - at - 1);
      if (digits.empty() || digits.size() > 6 || digits.find_first_not_of("0123456789") != std::string::npos ||
          steps.empty())
        throw malformed;
      steps.push_back({"", std::stoul(digits)});
      at = close + 1;
    } else {
      if (!steps.empty() && path[at++] != '.') throw malformed;
      const std::size_t end = std::min(path.find_first_of(".[", at), path.size());
      if (end == at) throw malformed;
      steps.push_back({path.substr(at, end - at), 0});
      at = end;
    }
  }
  if (steps.empty() || path.back() == '.') throw malformed;
  return steps;
}

/// Puts `value` at `path`; what is made on the way has the line and the file of the value.
void put(JsonNode& root, const std::string& path, JsonNode value, const InputError::Where& where) {
  JsonNode* node = &root;
  const auto made = [&](JsonNode& fresh) {
    fresh.line = value.line;
    fresh.file = value.file;
    return &fresh;
  };
  for (const Step& step : splitPath(path, where)) {
    const JsonNode::Type wanted = step.key.empty() ? JsonNode::Type::list : JsonNode::Type::object;
    if (node->type == JsonNode::Type::null) node->type = wanted;
    if (node->type != wanted)
      throw InputError(where, fmt::format("there is {} on the way, not {}", describe(*node),
                                          step.key.empty() ? "a list" : "an object"));
    JsonNode* next = nullptr;
    if (step.key.empty()) {
      if (step.index > node->children.size())
        throw InputError(where, fmt::format("index {}, but the list has {} items", step.index, node->children.size()));
      next = step.index < node->children.size() ? &node->children[step.index] : made(node->children.emplace_back());
    } else {
      next = node->find(step.key);
      if (!next) {
        next = made(node->children.emplace_back());
        next->key = step.key;
      }
    }
    node = next;
  }
  value.key = node->key;
  *node = std::move(value);
}

void setFile(JsonNode& node, const std::shared_ptr<const std::string>& file) {
  node.file = file;
  for (JsonNode& c : node.children) setFile(c, file);
}

}  // namespace

void overrideValue(JsonNode& root, const std::string& path, const std::string& value) {
  JsonNode parsed;
  try {
    parsed = parseJson(value, command_line);
    forgetLines(parsed);
  } catch (const InputError&) {
    parsed = {};
    parsed.type = JsonNode::Type::text;
    parsed.text = value;
  }
  put(root, path, std::move(parsed), {command_line, 0, path});
}

void overrideValue(JsonNode& root, const std::string& path, const JsonNode& value, const std::string& file) {
  JsonNode placed = value;
  setFile(placed, std::make_shared<const std::string>(file));
  put(root, path, std::move(placed), {file, value.line, path});
}

}  // namespace gambeson
