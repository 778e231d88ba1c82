#include "analysis/report/page_top.hpp"

#include <fstream>

#include "analysis/report/html.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr std::string_view kHeadline = "<section class=\"headline", kEnd = "</section>";

/// What stands between the first `open` at `from` or after it and `close`; `from` moves behind it. False where there is
/// none.
bool between(std::string_view text, std::string_view open, std::string_view close, std::size_t& from,
             std::string_view& found) {
  const std::size_t start = text.find(open, from);
  if (start == std::string_view::npos) return false;
  const std::size_t end = text.find(close, start + open.size());
  if (end == std::string_view::npos) return false;
  found = text.substr(start + open.size(), end - start - open.size());
  from = end + close.size();
  return true;
}

}  // namespace

PageTop pageTopOf(const std::string& page) {
  const std::string_view text(page);
  const std::size_t headline = text.find(kHeadline);
  const std::size_t end = headline == std::string_view::npos ? headline : text.find(kEnd, headline);
  PageTop top;
  std::size_t at = 0;
  std::string_view found;
  if (end == std::string_view::npos || !between(text, "<meta name=\"description\" content=\"", "\">", at, found))
    throw RunError("is no page of a run or a study");
  top.sentence = html::textOf(found);
  const std::string_view above = text.substr(at, headline - at), inside = text.substr(headline, end - headline);
  at = 0;
  while (between(above, "<p class=\"", "</p>", at, found))
    if (found.starts_with("alarm\"") || found.starts_with("notice\""))
      top.doubts.push_back(html::textOf(found.substr(found.find('>') + 1)));
  at = 0;
  if (between(inside, "<figure>", "</figure>", at, found)) top.figure = html::element("figure", found);
  return top;
}

PageTop readPageTop(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw RunError(file.string() + " cannot be read");
  std::string text, line;
  while (std::getline(stream, line)) {
    text.append(line).append("\n");
    if (line.starts_with(kEnd)) break;  // the headline is the first section
  }
  try {
    return pageTopOf(text);
  } catch (const RunError& e) {
    throw RunError(file.string() + " " + e.what());
  }
}

}  // namespace gambeson
