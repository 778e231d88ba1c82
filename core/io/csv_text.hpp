#pragma once
/// Texts in tables.

#include <string>
#include <string_view>
#include <vector>

namespace gambeson {

/// A text as a cell: quoted where it holds a comma, a quote or a line break (RFC 4180). One that begins with = + - @, a
/// tab or a line break and is no number has a ' in front, so that no spreadsheet takes it for a formula.
std::string csvText(const std::string& text);

/// The cells of a line (no line breaks within quotes), with what csvText added taken away.
std::vector<std::string> csvCells(std::string_view line);

/// A table of ours for spreadsheets with a decimal comma: cells between semicolons, the point of each number (a cell
/// that is one, whole) a comma. Texts stay, quoted where they hold a semicolon.
std::string europeanCsv(std::string_view csv);

}  // namespace gambeson
