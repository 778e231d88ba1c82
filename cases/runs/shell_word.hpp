#pragma once
/// Texts in scripts and in commands that are shown to be copied.

#include <string>
#include <string_view>

namespace gambeson {

/// One word of a POSIX shell that means `text` and nothing else. A text of letters, digits and _-+=.,:/@%^ stays as it
/// is; others stand in single quotes, within which only the quote itself needs care.
inline std::string shellWord(std::string_view text) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%^";
  if (!text.empty() && text.find_first_not_of(plain) == std::string_view::npos) return std::string(text);
  std::string word = "'";
  for (const char c : text)
    if (c == '\'')
      word += "'\\''";
    else
      word += c;
  return word + "'";
}

}  // namespace gambeson
