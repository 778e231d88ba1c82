#pragma once
/// Reads back what a page has for its viewer, independently of what wrote it: from the formats of packed.hpp and
/// viewer.hpp.

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace gambeson::viewed {

inline std::string inflated(const std::string& bytes) {
  std::string out(1 << 16, '\0');
  while (true) {
    uLongf size = out.size();
    const int status = uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                                  reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    if (status == Z_OK) {
      out.resize(size);
      return out;
    }
    if (status != Z_BUF_ERROR) throw std::runtime_error("not deflated");
    out.resize(2 * out.size());
  }
}

inline std::string fromBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  unsigned word = 0;
  int bits = 0;
  for (const char c : text) {
    const std::size_t at = digits.find(c);
    if (at == std::string::npos) continue;
    word = word << 6 | static_cast<unsigned>(at);
    bits += 6;
    if (bits >= 8) bits -= 8, out += static_cast<char>(word >> bits & 0xff);
  }
  return out;
}

template <class T>
std::vector<T> numbersOf(const std::string& bytes) {
  std::vector<T> out(bytes.size() / sizeof(T));
  std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
  return out;
}

/// p of [(frame, vertex, component)].
inline std::vector<int> decoded(const std::string& bytes, std::size_t frames, std::size_t vertices,
                                std::size_t components, const std::vector<int>& parents) {
  const std::size_t count = frames * vertices * components;
  if (bytes.size() != 2 * count) throw std::runtime_error("not as many codes as there should be");
  std::vector<int> p(count);
  const auto wrapped = [](int x) { return static_cast<int>(static_cast<std::int16_t>(static_cast<std::uint16_t>(x))); };
  std::size_t at = 0;
  for (std::size_t c = 0; c < components; ++c)
    for (std::size_t t = 0; t < frames; ++t) {
      std::vector<int> d(vertices);
      for (std::size_t v = 0; v < vertices; ++v, ++at) {
        const int z = static_cast<unsigned char>(bytes[at]) + 256 * static_cast<unsigned char>(bytes[count + at]);
        const int e = z % 2 == 0 ? z / 2 : -(z + 1) / 2;
        d[v] = e + (parents[v] >= 0 ? d[static_cast<std::size_t>(parents[v])] : 0);
        const std::size_t i = (t * vertices + v) * components + c;
        p[i] = wrapped(d[v] + (t > 0 ? p[i - vertices * components] : 0));
      }
    }
  return p;
}
inline std::vector<int> unpacked(const std::string& deflated, std::size_t frames, std::size_t vertices,
                                 std::size_t components, const std::vector<int>& parents) {
  return decoded(inflated(deflated), frames, vertices, components, parents);
}

/// The object of the first run and its blocks, still deflated.
struct PageRun {
  nlohmann::json head;
  std::vector<std::string> blocks;
  std::string first;  ///< inflated
  /// What the object names by where it begins and its length.
  std::string piece(const nlohmann::json& of) const { return first.substr(of[0], of[1]); }
  explicit PageRun(const std::string& html) {
    const auto inner = [&](std::size_t& from, const std::string& opening) {
      const std::size_t begin = html.find(opening, from);
      if (begin == std::string::npos) return std::string();
      const std::size_t end = html.find("</script>", begin);
      from = end;
      return html.substr(begin + opening.size(), end - begin - opening.size());
    };
    std::size_t at = 0;
    head = nlohmann::json::parse(inner(at, "<script type=\"application/json\" class=\"viewer-run\">"));
    first = inflated(fromBase64(inner(at, "<script type=\"text/plain\" class=\"viewer-first\" data-run=\"0\">")));
    const std::string opening = "<script type=\"text/plain\" class=\"viewer-block\" data-run=\"0\" data-block=\"";
    for (at = html.find(opening); at != std::string::npos; at = html.find(opening, at)) {
      const std::size_t number = std::stoul(html.substr(at + opening.size()));
      if (number >= blocks.size()) blocks.resize(number + 1);
      blocks[number] = fromBase64(inner(at, opening + std::to_string(number) + "\">"));
    }
  }
};

}  // namespace gambeson::viewed
