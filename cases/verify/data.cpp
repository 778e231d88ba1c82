/// Detail of verify.hpp: what a run left, as the checks read it.

#include <fmt/format.h>
#include <algorithm>

#include <charconv>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <variant>

#include "cases/verify/verify.hpp"
#include "core/error.hpp"
#include "core/io/csv_text.hpp"

namespace gambeson::verify {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double numberOf(const std::string& text) {
  double v = not_a_number;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
  return error == std::errc() && end == text.data() + text.size() ? v : not_a_number;
}

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw RunError(fmt::format("there is no {}", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The node at a path such as "modes[0].frequency_Hz". Keys may hold dots: the longest key that fits is taken.
const JsonNode* findPath(const JsonNode& node, std::string_view path) {
  if (path.empty()) return &node;
  if (path.front() == '[') {
    const std::size_t close = path.find(']');
    std::size_t index = 0;
    if (close == std::string_view::npos ||
        std::from_chars(path.data() + 1, path.data() + close, index).ptr != path.data() + close ||
        node.type != JsonNode::Type::list || index >= node.children.size())
      return nullptr;
    return findPath(node.children[index], path.substr(close + 1));
  }
  if (path.front() == '.') path.remove_prefix(1);
  const JsonNode* best = nullptr;
  for (const JsonNode& c : node.children) {
    if (c.key.empty() || !path.starts_with(c.key)) continue;
    const std::string_view rest = path.substr(c.key.size());
    if (!rest.empty() && rest.front() != '.' && rest.front() != '[') continue;
    if (!best || c.key.size() > best->key.size()) best = &c;
  }
  return best ? findPath(*best, path.substr(best->key.size())) : nullptr;
}

/// Reads the files that the checks name, once. A file that is missing is a reason, kept until it is asked for.
class Files : public RunNumbers {
 public:
  Files(const Reference& reference, const std::vector<Outcome>& outcomes) {
    for (std::size_t i = 0; i < reference.runs.size(); ++i) {
      const std::string& run = reference.runs[i].name;
      folders_[run] = outcomes[i].folder;
      if (!outcomes[i].why.empty()) failed_[run] = fmt::format("run {} failed: {}", run, outcomes[i].why);
    }
    const auto need = [&](const Quantity& q, const std::vector<std::string>& others) {
      for (const auto* runs : {&q.runs, &others})
        for (const std::string& run : *runs) q.summary.empty() ? loadTable(run, q.table) : loadSummary(run);
    };
    for (const Check& c : reference.checks) {
      if (c.kind == Check::Kind::value || c.kind == Check::Kind::rate) {
        need(c.of, c.kind == Check::Kind::rate ? c.runs : c.also);
        if (c.minus) need(*c.minus, c.also);
        if (c.over) need(*c.over, c.also);
      } else if (c.kind == Check::Kind::course) {
        for (const auto* h : {&c.first, &c.second})
          if (*h) loadTable((*h)->run, (*h)->table);
      } else {
        if (!c.run.empty()) loadTable(c.run, c.file);
        for (const auto* runs : {&c.also, &c.runs, &c.reference_runs})
          for (const std::string& run : *runs) loadTable(run, c.file);
      }
    }
  }

  double summary(const std::string& run, const std::string& path) const override {
    const JsonNode& root = get(run, summaries_.at(run));
    const JsonNode* node = findPath(root, path);
    if (!node) throw RunError(fmt::format("summary.json of run {} has no \"{}\"", run, path));
    if (node->type != JsonNode::Type::number)
      throw RunError(fmt::format("\"{}\" in summary.json of run {} is {}, not a number", path, run, describe(*node)));
    return node->number;
  }
  const Numbers& table(const std::string& run, const std::string& file) const override {
    return get(run, tables_.at({run, file}));
  }

 private:
  template <class T>
  using Loaded = std::variant<T, std::string>;

  template <class T>
  const T& get(const std::string& run, const Loaded<T>& loaded) const {
    if (const auto it = failed_.find(run); it != failed_.end()) throw RunError(it->second);
    if (const auto* why = std::get_if<std::string>(&loaded)) throw RunError(*why);
    return std::get<T>(loaded);
  }
  template <class Load>
  static auto attempt(Load load) -> Loaded<decltype(load())> {
    try {
      return load();
    } catch (const std::exception& e) {
      return std::string(e.what());
    }
  }
  void loadTable(const std::string& run, const std::string& file) {
    if (tables_.contains({run, file})) return;
    tables_.emplace(std::pair{run, file}, attempt([&] {
                      return parseCsv(contentOf(folders_.at(run) / file), (folders_.at(run) / file).string());
                    }));
  }
  void loadSummary(const std::string& run) {
    if (summaries_.contains(run)) return;
    summaries_.emplace(run, attempt([&] {
                         return readJson(folders_.at(run) / "summary.json",
                                         {.bytes = std::size_t{1} << 26, .depth = 64});
                       }));
  }

  std::map<std::string, std::filesystem::path> folders_;
  std::map<std::string, std::string> failed_;
  std::map<std::pair<std::string, std::string>, Loaded<Numbers>> tables_;
  std::map<std::string, Loaded<JsonNode>> summaries_;
};

}  // namespace

Numbers parseCsv(std::string_view text, const std::string& name) {
  Numbers t;
  std::size_t line = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view row = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line;
    if (row.empty() || row == "\r") continue;
    const std::vector<std::string> fields = csvCells(row);
    if (t.columns.empty()) {
      t.columns = fields;
      continue;
    }
    if (fields.size() != t.columns.size())
      throw RunError(fmt::format("{}:{}: {} cells for {} columns", name, line, fields.size(), t.columns.size()));
    for (t.rows.emplace_back(); const std::string& f : fields) t.rows.back().push_back(numberOf(f));
  }
  if (t.columns.empty()) throw RunError(fmt::format("{}: there is no table", name));
  return t;
}

Verified assess(const Reference& reference, const std::vector<Outcome>& outcomes) {
  Verified v{reference, outcomes, {}, 0};
  for (const Outcome& o : outcomes) v.seconds += o.seconds;
  const Files files(reference, outcomes);
  for (const Check& c : reference.checks) v.judged.push_back(judge(reference, c, files));
  return v;
}

std::vector<Result> Verified::results() const {
  std::vector<Result> all;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (outcomes[i].why.empty()) continue;
    Result r;
    r.id = reference.id;
    r.source = reference.source;
    r.quantity = "run " + reference.runs[i].name;
    r.note = outcomes[i].why;
    all.push_back(r);
  }
  for (const Judged& j : judged) all.insert(all.end(), j.results.begin(), j.results.end());
  for (Result& r : all) r.seconds = seconds;
  return all;
}

bool Verified::gates() const {
  return std::any_of(reference.checks.begin(), reference.checks.end(), [](const Check& c) { return c.gates(); });
}

bool Verified::passed() const {
  for (const Result& r : results())
    if (r.gated && !r.passed) return false;
  return true;
}

}  // namespace gambeson::verify
