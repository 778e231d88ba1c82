#include "cases/input/message.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cstdio>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr std::size_t most_bytes = 390, kept_at_end = 130, most_quoted = 80;
constexpr std::string_view left_out = " [...] ";

/// Bytes of the character that `text` begins with, 0 where that is no UTF-8. (Unicode 15, table 3-7.)
std::size_t characterOf(std::string_view text) {
  const auto byte = [&](std::size_t k) -> unsigned {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0;
  };
  const unsigned a = byte(0);
  if (a < 0x80) return 1;
  const std::size_t size = a >= 0xc2 && a <= 0xdf ? 2 : a >= 0xe0 && a <= 0xef ? 3 : a >= 0xf0 && a <= 0xf4 ? 4 : 0;
  for (std::size_t k = 1; k < size; ++k)
    if ((byte(k) & 0xc0) != 0x80) return 0;
  if ((a == 0xe0 && byte(1) < 0xa0) || (a == 0xed && byte(1) > 0x9f) || (a == 0xf0 && byte(1) < 0x90) ||
      (a == 0xf4 && byte(1) > 0x8f))
    return 0;
  return size;
}

/// C0, DEL and C1, which terminals act on.
bool isControl(std::string_view character) {
  const unsigned a = static_cast<unsigned char>(character[0]);
  return a < 0x20 || a == 0x7f || (a == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0);
}

/// The text with no more than the first bytes of what it quotes. An apostrophe after a letter opens no quotation, one
/// before a letter closes none.
std::string shortQuotations(std::string_view text) {
  const auto isLetter = [&](std::size_t at) {
    return at < text.size() && std::isalnum(static_cast<unsigned char>(text[at])) != 0;
  };
  const auto closing = [&](std::size_t from) {
    std::size_t at = text.find('\'', from);
    while (at != std::string_view::npos && isLetter(at + 1)) at = text.find('\'', at + 1);
    return at;
  };
  std::string out;
  std::size_t at = 0;
  for (std::size_t open = text.find('\''); open != std::string_view::npos; open = text.find('\'', open)) {
    const bool opens = open == 0 || !isLetter(open - 1);
    const std::size_t end = opens ? closing(open + 1) : std::string_view::npos;
    if (end == std::string_view::npos) {
      if (opens) break;
      ++open;
      continue;
    }
    if (end - open - 1 > most_quoted) {
      std::size_t kept = open + 1 + most_quoted;
      while ((static_cast<unsigned char>(text[kept]) & 0xc0) == 0x80) --kept;
      out.append(text.substr(at, kept - at)).append("[...]");
      at = end;
    }
    open = end + 1;
  }
  return out.append(text.substr(at));
}

}  // namespace

std::string messageText(std::string_view whole) {
  const std::string shorter = shortQuotations(whole);
  std::string_view text = shorter;
  // Beyond this nothing is shown: the parts that are kept come from the first and the last bytes alone.
  std::string shown;
  const auto add = [&](std::string_view part) {
    while (!part.empty()) {
      const std::size_t size = characterOf(part), take = size > 0 ? size : 1;
      const std::string_view character = part.substr(0, take);
      if (size > 0 && (!isControl(character) || character == "\n"))
        shown += character;
      else
        for (const char c : character) shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
      part.remove_prefix(take);
    }
  };
  if (text.size() > 2 * most_bytes) {
    add(text.substr(0, most_bytes));
    add(text.substr(text.size() - most_bytes));
  } else {
    add(text);
  }
  if (shown.size() <= most_bytes && text.size() <= 2 * most_bytes) return shown;
  const auto boundary = [&](std::size_t at) {
    while (at < shown.size() && (static_cast<unsigned char>(shown[at]) & 0xc0) == 0x80) --at;
    return at;
  };
  const std::size_t head = boundary(most_bytes - kept_at_end - left_out.size() - 3);
  return shown.substr(0, head).append(left_out).append(shown.substr(boundary(shown.size() - kept_at_end)));
}

namespace {
thread_local std::FILE* told_to = nullptr;
}

std::FILE* notes() { return told_to ? told_to : stderr; }

NotesTo::NotesTo(std::FILE* stream) : before_(told_to) { told_to = stream; }

NotesTo::~NotesTo() { told_to = before_; }

void sayNote(const std::string& note) { fmt::print(notes(), "{}\n", messageText("note: " + note)); }

std::string unfitText(std::string_view text, bool lines) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = characterOf(text.substr(at));
    if (size == 0) return "this is not UTF-8 text";
    if (isControl(text.substr(at, size)) && !(lines && (text[at] == '\n' || text[at] == '\t')))
      return fmt::format("holds the control character {}; allowed: text without such characters{}",
                         messageText(text.substr(at, size) == "\n" ? "line break" : text.substr(at, size)),
                         lines ? " but line breaks and tabs" : "");
    at += size;
  }
  return "";
}

void checkPath(const std::filesystem::path& path, const std::string& option) {
  if (const std::string why = unfitText(path.string()); !why.empty())
    throw InputError({"command line", 0, option}, why);
}

std::string jsonReason(std::string_view what) {
  if (what.starts_with("[json.exception"))
    if (const std::size_t end = what.find("] "); end != std::string_view::npos) what.remove_prefix(end + 2);
  return std::string(what);
}

}  // namespace gambeson
