#pragma once
/// The pieces that pages are made of: all HTML.

#include <string>

#include "analysis/report/report.hpp"

namespace gambeson {

std::string tableOf(const Table& table);
/// What fails, in one paragraph for the top of the page, and the table that it points to (#audit); empty where all
/// hold.
std::string alarmOf(const std::vector<AuditCheck>& checks);
std::string auditTableOf(const std::vector<AuditCheck>& checks, const std::string& caption);
std::string figureOf(const Picture& picture);
/// A section with a heading; `lead` is text, `body` HTML.
std::string pageSectionOf(const std::string& id, const std::string& title, const std::string& lead,
                          const std::string& body);
/// A whole page; `summary` is text for search and previews, `body` HTML; `viewed`: it has a viewer (viewerSection);
/// `style`: rules of its own.
std::string pageOf(const std::string& title, const std::string& description, const std::string& summary,
                   const std::string& body, bool viewed = false, const std::string& style = "");

}  // namespace gambeson
