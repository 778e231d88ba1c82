#include "analysis/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "analysis/ticks.hpp"

namespace gambeson::html {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isAlpha(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// The length of a quantity ("1.83 Nm") that starts here, 0 where none does.
std::size_t quantityAt(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && (isDigit(text[n]) || (n > 0 && text[n] == '.'))) ++n;
  if (n == 0 || n >= text.size() || text[n] != ' ') return 0;
  for (const std::string_view unit : {"Nm", "N/m", "N", "kPa", "Pa", "%", "s", "kg", "mm", "m"}) {
    const std::size_t end = n + 1 + unit.size();
    if (text.substr(n + 1, unit.size()) == unit && (end >= text.size() || !(isAlpha(text[end]) || isDigit(text[end]))))
      return end;
  }
  return 0;
}

}  // namespace

std::string escape(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string textOf(std::string_view html) {
  static constexpr std::pair<std::string_view, char> entities[]{
      {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&#39;", '\''}};
  std::string out;
  for (std::size_t i = 0; i < html.size();) {
    if (html[i] == '<') {
      const std::size_t end = html.find('>', i);
      i = end == std::string_view::npos ? html.size() : end + 1;
      continue;
    }
    const auto* entity = std::find_if(std::begin(entities), std::end(entities),
                                      [&](const auto& e) { return html.substr(i).starts_with(e.first); });
    out += entity == std::end(entities) ? html[i] : entity->second;
    i += entity == std::end(entities) ? 1 : entity->first.size();
  }
  return out;
}

std::string prose(const std::string& text) {
  const std::string safe = escape(text);
  std::string out;
  for (std::size_t i = 0; i < safe.size();) {
    const bool inside = i > 0 && (isDigit(safe[i - 1]) || isAlpha(safe[i - 1]) || safe[i - 1] == '.');
    const std::size_t n = inside ? 0 : quantityAt(std::string_view(safe).substr(i));
    if (n > 0)
      out += "<span class=\"q\">" + safe.substr(i, n) + "</span>", i += n;
    else
      out += safe[i++];
  }
  return out;
}

std::string base64(std::string_view bytes) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  const auto byte = [&](std::size_t i) { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u; };
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned word = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    out += digits[word >> 18 & 63];
    out += digits[word >> 12 & 63];
    out += i + 1 < bytes.size() ? digits[word >> 6 & 63] : '=';
    out += i + 2 < bytes.size() ? digits[word & 63] : '=';
  }
  return out;
}

std::string element(std::string_view name, std::string_view content, std::string_view attributes) {
  std::string out = "<";
  out.append(name).append(attributes).append(">").append(content).append("</").append(name).append(">\n");
  return out;
}

std::string tablePanel(std::string_view title, std::string_view rows, std::string_view after) {
  const std::string table = element("table", element("caption", element("span", escape(title))) + std::string(rows));
  return element("div", element("div", table, " class=\"scroll\" tabindex=\"0\"") + std::string(after),
                 " class=\"panel\"");
}

std::string markOf(std::string_view light) { return light == "doubtful" ? "\u25d0" : "\u25cf"; }

std::string lightOf(std::string_view light) {
  return element("span", markOf(light) + " " + escape(light), " class=\"light " + escape(light) + "\"");
}

std::string notice(std::string_view text) { return element("p", escape(text), " class=\"notice\""); }

std::string seconds(double time_s) {
  return (std::isfinite(time_s) ? fmt::format("{:.2f}", time_s) : formatNumber(time_s)) + " s";
}

}  // namespace gambeson::html
