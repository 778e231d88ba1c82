#pragma once
/// Text and bytes as HTML carries them.

#include <string>
#include <string_view>

namespace gambeson::html {

/// & < > " ' as entities, for text and for attribute values in quotes.
std::string escape(std::string_view text);

/// The text of HTML that `escape` and `element` made: without its tags, entities as what they stand for.
std::string textOf(std::string_view html);

/// Escaped text in which a number and its unit stay on one line.
std::string prose(const std::string& text);

/// RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

/// <name attributes>content</name>; `content` is HTML already. Attributes are given with a leading space or empty.
std::string element(std::string_view name, std::string_view content, std::string_view attributes = "");

/// A table in its panel; title and first column stay in sight where the table is wider than the page. `rows` and
/// `after`, which stands below, are HTML.
std::string tablePanel(std::string_view title, std::string_view rows, std::string_view after = "");

/// The sign of a light, which tells a doubtful one from the others without its colour.
std::string markOf(std::string_view light);

/// A light in its colour, with its sign and as a word.
std::string lightOf(std::string_view light);

/// A paragraph for what is missing, visible to all.
std::string notice(std::string_view text);

/// A time to 10 ms, the window of the torques: "1.24 s".
std::string seconds(double time_s);

}  // namespace gambeson::html
