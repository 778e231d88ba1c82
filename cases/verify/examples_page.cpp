/// Detail of examples.hpp: the page of a work: its examples at a glance, then statement by statement with what was
/// measured beside it.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "analysis/report/html.hpp"
#include "analysis/report/style.hpp"
#include "analysis/ticks.hpp"
#include "cases/verify/examples.hpp"

namespace gambeson::verify {
namespace {

using html::element;
using html::escape;

constexpr const char* kWorkStyle = R"css(
section.example { border-top:1px solid var(--line); margin-top:36px; } section.example h3 { font-size:1.15rem; margin:18px 0 4px; }
.doc { max-width:80ch; margin:8px 0; } .soft { color:var(--soft); } a { color:var(--accent); } .panel { margin-top:14px; }
table.statements td { vertical-align:top; } table.statements td.words { max-width:46ch; }
)css";

/// What stands beside a statement.
enum class Standing { holds, fails, reported, off, recorded, waits, none };

struct Beside {
  Standing standing = Standing::none;
  const Result* result = nullptr;
};

Beside besideOf(const Statement& s, const std::vector<Result>& results) {
  if (s.reference.empty()) return {};
  for (const Result& r : results) {
    if (r.id != s.reference || r.quantity != s.quantity || r.other_run) continue;
    if (r.gated) return {r.passed ? Standing::holds : Standing::fails, &r};
    return {r.passed ? Standing::reported : Standing::off, &r};
  }
  return {s.recorded ? Standing::recorded : Standing::waits, nullptr};
}

std::string word(Standing s) {
  switch (s) {
    case Standing::holds:
      return "<span class=\"good\">holds</span>";
    case Standing::fails:
      return "<span class=\"bad\">FAILS</span>";
    case Standing::reported:
      return "<span class=\"soft\">reported</span>";
    case Standing::off:
      return "<span class=\"soft\">reported, off</span>";
    case Standing::recorded:
      return "<span class=\"soft\">earlier run</span>";
    case Standing::waits:
      return "<span class=\"soft\">not run</span>";
    case Standing::none:
      return "<span class=\"soft\">no number</span>";
  }
  return "";
}

/// Without zeros at its end.
std::string brief(double x, int digits) {
  const std::string s = formatNumber(x, digits);
  return s.find('e') == std::string::npos ? formatBrief(x, digits) : s;
}

std::string number(double x, const std::string& unit) {
  return brief(x, 4) + (unit.empty() || unit == "1" ? "" : " " + unit);
}

/// "0.3296 within 0.12 of 0.33", "at least 0.9", as the check asks.
std::string goal(const Result& r) {
  if (!r.reference) return "";
  if (r.tolerance) return fmt::format("within {} of {}", brief(*r.tolerance, 3), number(*r.reference, r.unit));
  return fmt::format("{} {}", r.note.starts_with("at least") ? "at least" : "at most", number(*r.reference, r.unit));
}

/// A bound's note begins with its kind, which the goal says.
std::string noteOf(const Result& r) {
  for (const std::string bound : {"at least", "at most"})
    if (!r.tolerance && r.note.starts_with(bound)) return r.note.substr(std::min(r.note.size(), bound.size() + 2));
  return r.note;
}

std::string ours(const Statement& s, const Beside& b) {
  if (b.standing == Standing::none) return escape(s.without);
  std::string text;
  if (b.result && b.result->measured) {
    text = element("b", escape(number(*b.result->measured, b.result->unit)));
    const std::string asked = goal(*b.result);
    if (!asked.empty()) text += escape(" (" + asked + ")");
  } else if (b.result) {
    text = "no number";
  } else if (s.recorded) {
    text = element("b", escape(brief(s.recorded->value, 4))) +
           escape(fmt::format(" on {}, not run this time", s.recorded->date));
  } else {
    text = escape(fmt::format("not run this time: gambeson verify --filter {}", s.reference));
  }
  text += "<br><span class=\"soft\">" + escape(s.quantity) + "</span>";
  const std::string note = b.result ? noteOf(*b.result) : "";
  if (!note.empty()) text += "<br><span class=\"soft\">" + escape(note) + "</span>";
  return text;
}

std::string link(const std::string& reference, bool there) {
  return there ? fmt::format("<a href=\"verify.html#{0}\">{0}</a>", escape(reference)) : escape(reference);
}

std::string statementTable(const Example& e, const std::vector<Result>& results) {
  std::string rows;
  for (const Statement& s : e.statements) {
    const Beside b = besideOf(s, results);
    rows += element("tr", element("td", word(b.standing)) + element("td", escape(s.where)) +
                              element("td", escape(s.published), " class=\"words\"") +
                              element("td", ours(s, b), " class=\"words\"") +
                              element("td", s.reference.empty() ? "" : link(s.reference, b.result != nullptr)));
  }
  const std::string heads =
      "<thead><tr><th></th><th>where</th><th>there</th><th>here</th><th>reference</th></tr></thead>";
  return element("div", element("table", heads + element("tbody", rows), " class=\"statements\""),
                 " class=\"panel scroll\"");
}

std::string joined(const std::vector<std::string>& numbers, const std::string& name, const std::string& names) {
  if (numbers.empty()) return "";
  return fmt::format("{} {}", numbers.size() == 1 ? name : names, fmt::join(numbers, ", "));
}

std::string illustrations(const Example& e) {
  const std::string figures = joined(e.figures, "fig.", "figs."), tables = joined(e.tables, "table", "tables");
  return figures + (figures.empty() || tables.empty() ? "" : "; ") + tables;
}

std::string caseNames(const Example& e) {
  std::string text;
  for (const auto& c : e.cases) text += (text.empty() ? "" : ", ") + c.stem().string();
  return text;
}

/// "3 hold, 1 fails, 2 reported".
std::string tally(const Example& e, const std::vector<Result>& results) {
  int count[7] = {};
  for (const Statement& s : e.statements) ++count[static_cast<int>(besideOf(s, results).standing)];
  std::string text;
  const auto say = [&](int n, const std::string& what) {
    if (n > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, what);
  };
  const auto of = [&](Standing s) { return count[static_cast<int>(s)]; };
  say(of(Standing::holds), "held");
  const std::string good = std::exchange(text, "");
  if (of(Standing::fails) > 0) text = fmt::format("<span class=\"bad\">{} FAILED</span>", of(Standing::fails));
  say(of(Standing::reported) + of(Standing::off), "reported");
  say(of(Standing::recorded), "of an earlier run");
  say(of(Standing::waits), "not run");
  say(of(Standing::none), "without a number");
  if (good.empty()) return text;
  return element("span", good, " class=\"good\"") + (text.empty() ? "" : ", " + text);
}

std::string overview(const Work& work, const std::vector<Result>& results) {
  std::string rows;
  for (const Example& e : work.examples)
    rows += element("tr", element("td", fmt::format("<a href=\"#s{0}\">{0}</a>", escape(e.section))) +
                              element("td", escape(e.title)) + element("td", escape(illustrations(e))) +
                              element("td", escape(caseNames(e))) + element("td", tally(e, results)));
  const std::string heads =
      "<thead><tr><th>section</th><th>example</th><th>there</th><th>case</th><th>statements</th></tr></thead>";
  return element("div", element("table", heads + element("tbody", rows)), " class=\"panel scroll\"");
}

std::string pageSection(const Example& e, const std::vector<Result>& results) {
  std::string head = element("h3", escape(e.section + " " + e.title));
  std::string line = illustrations(e);
  if (!e.cases.empty()) line += (line.empty() ? "" : ". ") + std::string("Case: ") + caseNames(e);
  head += element("p", escape(line), " class=\"soft\"");
  if (!e.doc.empty()) head += element("p", escape(e.doc), " class=\"doc\"");
  return element("section", head + statementTable(e, results),
                 fmt::format(" class=\"example\" id=\"s{}\"", escape(e.section)));
}

}  // namespace

std::string formatWork(const Work& work, const std::vector<Verified>& done, const std::string& command) {
  std::vector<Result> results;
  for (const Verified& v : done)
    for (const Result& r : v.results()) results.push_back(r);
  std::string body = overview(work, results);
  for (const Example& e : work.examples) body += pageSection(e, results);
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n" +
         element("title", escape(work.title)) + "\n<style>" + std::string(report::kStyle) + kWorkStyle +
         "</style></head>\n<body>\n" +
         element("header",
                 element("h1", escape(work.title)) + element("p", escape(work.source)) + element("p", escape(work.doc)),
                 " class=\"page\"") +
         element("main", body) +
         element("footer",
                 element("main", escape(fmt::format("Written by gambeson {}: {}.", GAMBESON_VERSION, command)))) +
         "</body></html>\n";
}

}  // namespace gambeson::verify
