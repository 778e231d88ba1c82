#pragma once
/// Where in its file stands what turns out to be wrong only as something is built from a case.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/input/schema.hpp"
#include "core/error.hpp"

namespace gambeson {

/// Runs f; an InputError of it that names no file gets this key before its own. Units of names in the code ("inseam_m")
/// are taken off: those of the file have none.
template <class F>
auto underKey(const std::string& key, F&& f);

/// The key of an error behind `outer`: "garments[0].shorts" and "inseam_m" give "garments[0].shorts.inseam".
std::string keyUnder(const std::string& outer, const std::string& inner);

template <class F>
auto underKey(const std::string& key, F&& f) {
  try {
    return f();
  } catch (const InputError& e) {
    if (!e.where().file.empty()) throw;
    throw InputError({"", 0, keyUnder(key, e.where().key)}, e.reason());
  }
}

/// Throws e again, at the deepest entry of its key that the file has; the rest of the key is part of the words. A
/// single garment may stand as "garment" or in "garments". What names a file of its own is thrown as it is.
[[noreturn]] void sayAt(const schema::Entry& root, const InputError& e);

/// The same for a case that was read from a file with overrides (--set).
[[noreturn]] void sayInCase(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                            const InputError& e);

}  // namespace gambeson
