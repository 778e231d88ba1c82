#pragma once
/// The pieces that pages are made of: all HTML.

#include <string>

#include "analysis/report/report.hpp"

namespace gambeson {

std::string tableOf(const Table& table);
std::string figureOf(const Picture& picture);
/// A section with a heading; `lead` is text, `body` HTML.
std::string sectionOf(const std::string& id, const std::string& title, const std::string& lead,
                      const std::string& body);
/// A whole page; `summary` is text for search and previews, `body` HTML.
std::string pageOf(const std::string& title, const std::string& description, const std::string& summary,
                   const std::string& body);

}  // namespace gambeson
