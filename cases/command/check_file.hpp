#pragma once
/// Files that `gambeson check` knows beside cases: patterns, garments, cards, laws, studies, motions, meshes, results.

#include <filesystem>
#include <iosfwd>

namespace gambeson {

/// Says what a file or a folder of results is, once it was read whole by the reader that commands use: "denim.json:
/// fabric card, valid; ...". False, and nothing said, where it is none of these: a case, or no file at all. Throws
/// InputError where it is one of these but not sound, or of a sort that is checked with another file.
bool checkFile(const std::filesystem::path& file, std::ostream& out);

}  // namespace gambeson
