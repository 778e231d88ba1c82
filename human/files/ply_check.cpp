#include "human/files/ply_check.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "core/error.hpp"
#include "human/files/read_text.hpp"

namespace gambeson {
namespace {

struct Property {
  std::size_t count_bytes = 0;  ///< 0: no list
  std::size_t bytes = 0;
};
struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

std::size_t bytesOf(std::string_view type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "int" || type == "uint" || type == "float" || type == "int32" || type == "uint32" || type == "float32")
    return 4;
  if (type == "double" || type == "float64") return 8;
  return 0;
}

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> out;
  for (;;) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return out;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(" \t\r"), line.size());
    out.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

struct Ply {
  std::string file;
  std::string_view rest;
  int line = 0;

  [[noreturn]] void fail(const std::string& key, const std::string& reason) const {
    throw InputError({file, line, key}, reason);
  }

  std::string_view next() {
    ++line;
    if (rest.empty()) fail("", "the file ends here; it is cut off");
    const std::size_t end = rest.find('\n');
    const std::string_view out = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    return out;
  }

  void ascii(const Element& e) {
    for (std::uint64_t i = 0; i < e.count; ++i) {
      auto row = words(next());
      std::size_t at = 0;
      const auto number = [&] {
        double value;
        if (at >= row.size()) fail(e.name, "has too few numbers");
        if (!parseNumber(row[at++], value))
          fail(e.name, fmt::format("'{}' is not a finite number", row[at - 1].substr(0, 40)));
        return value;
      };
      for (const Property& p : e.properties) {
        double n = p.count_bytes > 0 ? number() : 1;
        if (n < 0 || n > static_cast<double>(row.size()))
          fail(e.name, fmt::format("a list of {} has too few numbers", n));
        for (; n > 0; --n) number();
      }
    }
  }

  void binary(const Element& e, bool big) {
    const auto take = [&](std::uint64_t bytes) {
      if (bytes > rest.size()) throw InputError({file, 0, e.name}, "the file ends within these; it is cut off");
      const std::string_view out = rest.substr(0, bytes);
      rest.remove_prefix(bytes);
      return out;
    };
    for (std::uint64_t i = 0; i < e.count; ++i)
      for (const Property& p : e.properties) {
        std::uint64_t n = 1;
        if (p.count_bytes > 0) {
          const std::string_view raw = take(p.count_bytes);
          n = 0;
          for (std::size_t k = 0; k < raw.size(); ++k)
            n = n << 8 | static_cast<unsigned char>(raw[big ? k : raw.size() - 1 - k]);
        }
        take(n * p.bytes);
      }
  }
};

}  // namespace

void checkPly(std::string_view text, const std::string& file) {
  Ply ply{file, text};
  if (words(ply.next()) != std::vector<std::string_view>{"ply"}) ply.fail("", "does not start with 'ply'");
  std::string format;
  std::vector<Element> elements;
  for (;;) {
    const auto w = words(ply.next());
    const std::string_view first = w.empty() ? std::string_view{} : w[0];
    if (first == "end_header") break;
    if (first == "comment" || first == "obj_info") continue;
    double count = 0;
    if (first == "format" && w.size() == 3) {
      format = w[1];
    } else if (first == "element" && w.size() == 3 && parseNumber(w[2], count) && count >= 0) {
      if (count > static_cast<double>(text.size()))
        ply.fail("element", fmt::format("announces {} items; the file has {} bytes", count, text.size()));
      elements.push_back({std::string(w[1]), static_cast<std::uint64_t>(count), {}});
    } else if (first == "property" && !elements.empty() && w.size() == 3 && bytesOf(w[1]) > 0) {
      elements.back().properties.push_back({0, bytesOf(w[1])});
    } else if (first == "property" && !elements.empty() && w.size() == 5 && w[1] == "list" && bytesOf(w[2]) > 0 &&
               bytesOf(w[3]) > 0) {
      elements.back().properties.push_back({bytesOf(w[2]), bytesOf(w[3])});
    } else {
      ply.fail("", "this line of the header is not understood");
    }
  }
  const bool ascii = format == "ascii", big = format == "binary_big_endian";
  if (!ascii && !big && format != "binary_little_endian")
    ply.fail("format", "must be ascii or binary_little_endian or binary_big_endian");
  bool vertices = false;
  for (const Element& e : elements) {
    if (e.properties.empty()) ply.fail(e.name, "has no properties");
    vertices = vertices || (e.name == "vertex" && e.count > 0);
    ascii ? ply.ascii(e) : ply.binary(e, big);
  }
  if (!vertices) ply.fail("", "announces no vertices");
}

}  // namespace gambeson
