/// Detail of gallery.hpp: the page.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "analysis/report/html.hpp"
#include "analysis/report/parts.hpp"
#include "cases/gallery/gallery.hpp"

namespace gambeson::gallery {
namespace {

using html::element;
using html::escape;
using html::prose;

constexpr const char* kGalleryStyle = R"css(
nav.sorts { display:flex; flex-wrap:wrap; gap:6px 18px; margin:18px 0 0; } nav.sorts a, .exhibit a, .alarm a { color:var(--accent); }
.gallery { display:grid; grid-template-columns:repeat(auto-fill,minmax(min(100%,320px),1fr)); gap:16px; margin-top:14px; }
.exhibit { display:flex; flex-direction:column; background:var(--paper); border:1px solid var(--line); border-radius:10px; overflow:hidden; overflow-wrap:anywhere; min-width:0; }
.exhibit figure { margin:0; border-bottom:1px solid var(--line); } .exhibit img { display:block; width:100%; aspect-ratio:4/3; object-fit:contain; background:#f9fafa; }
.exhibit figcaption, .exhibit .file { font-size:.86rem; color:var(--soft); } .exhibit figcaption { padding:6px 16px 8px; }
.exhibit .words { padding:12px 16px 14px; display:flex; flex-direction:column; flex:1; gap:8px; } .exhibit p { margin:0; } .exhibit h3 { margin:0; }
.exhibit .question { color:var(--soft); } .exhibit .answer { font-weight:600; } .exhibit .file { margin-top:auto; }
.exhibit .alarm, .exhibit .notice { font-size:.9rem; font-weight:400; padding:6px 10px; } .exhibit .alarm b { font-weight:600; }
ul.assumptions { overflow-wrap:anywhere; }
@media print { .gallery { grid-template-columns:repeat(3,1fr); } .exhibit { break-inside:avoid; } }
)css";

struct SortText {
  Sort sort;
  const char *id, *title, *lead;
};
constexpr std::array<SortText, 5> kSorts{{
    {Sort::worn, "worn", "Garments on people",
     "Cloth that a wearer moves in; the answer is what it costs at the joints."},
    {Sort::cloth, "cloth", "Cloth without a wearer", "Cloth that falls, folds, slides and is pulled."},
    {Sort::structure, "structures", "Structures", "Sheets with supports and loads: static, dynamic and modal cases."},
    {Sort::cell, "cells", "Cells of yarns", "One repeat of a weave, from whose yarns the cloth's stiffness follows."},
    {Sort::study, "studies", "Studies", "Variants of a case, run and compared."},
}};

/// A picture; or why there is none.
std::string pictureOf(const Exhibit& e) {
  if (!e.top.figure.empty()) return e.top.figure;
  return element("div", html::notice("No picture: " + (e.no_page.empty() ? "its report begins with none." : e.no_page)),
                 " class=\"words\" style=\"flex:none\"");
}

std::string exhibitOf(const Exhibit& e) {
  const std::string report = escape(e.folder) + "/report.html";
  const std::string title =
      e.no_page.empty() ? element("a", escape(e.title), " href=\"" + report + "\"") : escape(e.title);
  std::string words = element("h3", title);
  const Question q = questionOf(e.description);
  if (q.text.empty()) words += element("p", "This case has no description.", " class=\"question\"");
  if (!q.text.empty()) words += element("p", prose(q.text), " class=\"question\"");
  if (!e.failed.empty())
    words += element("p", element("b", "The run failed:") + escape(" " + e.failed), " class=\"alarm\"");
  if (!e.top.sentence.empty()) words += element("p", prose(e.top.sentence), " class=\"answer\"");
  for (const std::string& doubt : e.top.doubts) words += html::notice(doubt);
  words += element("p", escape(e.folder + ".json"), " class=\"file\"");
  return element("article", pictureOf(e) + element("div", words, " class=\"words\""),
                 " class=\"exhibit\" id=\"case_" + escape(e.folder) + "\"");
}

/// Which failed, each with a link to what is said of it.
std::string failuresOf(const std::vector<Exhibit>& exhibits) {
  std::string names;
  int failed = 0;
  for (const Exhibit& e : exhibits) {
    if (e.failed.empty()) continue;
    names +=
        (failed++ == 0 ? "" : ", ") + fmt::format("<a href=\"#case_{}\">{}</a>", escape(e.folder), escape(e.title));
  }
  if (failed == 0) return "";
  return element("p", fmt::format("{} of {} failed: {}.", failed, exhibits.size(), names),
                 " class=\"alarm\" role=\"alert\"");
}

/// Not after "fig." and the like, nor where what follows begins no sentence: "section 3.7.2", "fig. 8".
bool endsSentence(const std::string& text, std::size_t stop) {
  if (stop + 1 == text.size()) return true;
  if (text[stop + 1] != ' ' || stop + 2 >= text.size()) return false;
  if (std::isupper(static_cast<unsigned char>(text[stop + 2])) == 0) return false;
  const std::size_t blank = text.find_last_of(" (", stop);
  const std::string word = text.substr(blank == std::string::npos ? 0 : blank + 1, stop - blank - 1);
  constexpr std::array short_words{"fig", "figs", "eq", "eqs", "e.g", "i.e", "St", "Dr", "cf", "No", "vs"};
  return std::find(short_words.begin(), short_words.end(), word) == short_words.end();
}

}  // namespace

Question questionOf(const std::string& description) {
  Question q;
  std::string first;
  int open = 0;
  for (std::size_t i = 0, start = 0; i < description.size(); ++i) {
    const char c = description[i];
    open += (c == '(') - (c == ')');
    const bool last = i + 1 == description.size();
    if (!last && ((c != '.' && c != '?' && c != '!') || open > 0 || !endsSentence(description, i))) continue;
    const std::string sentence = description.substr(start, i + 1 - start);
    if (first.empty()) first = sentence;
    if (c == '?') q.text += (q.text.empty() ? "" : " ") + sentence;
    start = description.find_first_not_of(' ', i + 1);
    if (start == std::string::npos) break;
    i = start - 1;
  }
  q.asked = !q.text.empty();
  if (!q.asked) q.text = first;
  return q;
}

std::string formatGallery(const std::vector<Exhibit>& exhibits, const std::vector<LeftOut>& left_out) {
  std::string links, body;
  const auto link = [&](const std::string& id, const std::string& title, std::size_t count) {
    links += fmt::format("<a href=\"#{}\">{} ({})</a>\n", id, title, count);
  };
  for (const SortText& sort : kSorts) {
    std::string shown;
    std::size_t count = 0;
    for (const Exhibit& e : exhibits)
      if (e.sort == sort.sort) shown += exhibitOf(e), ++count;
    if (count == 0) continue;
    link(sort.id, sort.title, count);
    body += pageSectionOf(sort.id, sort.title, sort.lead, element("div", shown, " class=\"gallery\""));
  }
  if (!left_out.empty()) {
    link("left_out", "Not shown", left_out.size());
    std::string files;
    for (const auto& [file, why] : left_out) files += element("li", escape(file.string() + ": " + why));
    body += pageSectionOf("left_out", "Not shown", "What else is in the library, and why it has no place above.",
                          element("details", element("summary", fmt::format("{} files", left_out.size())) +
                                                 element("ul", files, " class=\"assumptions\"")));
  }
  return pageOf("Gallery",
                "Each case with its picture, what it asks or shows, and its answer. A title leads to the report.",
                fmt::format("{} cases and studies: their pictures, questions and answers.", exhibits.size()),
                failuresOf(exhibits) + element("nav", links, " class=\"sorts\" aria-label=\"Kinds of cases\"") + body,
                false, kGalleryStyle);
}

}  // namespace gambeson::gallery
