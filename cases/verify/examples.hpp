#pragma once
/// A published work, example by example: what each example has, what this program has beside it, and where the work
/// gives no number. The list is a file, tests/verify/examples/<id>.json; the numbers are those of references.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/verify/verify.hpp"

namespace gambeson::verify {

/// One statement of an example. Either a check stands beside it, or `without` says why none can.
struct Statement {
  std::string where;                ///< "table 2.1", "fig. 3.8 (a)", "text"
  std::string published;            ///< what the work has there, in words and numbers
  std::string reference, quantity;  ///< id of a reference, and the quantity of one of its checks
  std::string without;              ///< why no check stands beside it: there is no number, or ours cannot be compared
  /// What the check measured when its reference last ran, for references that run only by name.
  struct Recorded {
    double value = 0;
    std::string date;  ///< 2026-11-22
  };
  std::optional<Recorded> recorded;
};

struct Example {
  std::string section, title;
  std::vector<std::string> figures, tables;  ///< numbers of the work's figures and tables
  std::vector<std::filesystem::path> cases;  ///< case files that run it
  std::string doc;                           ///< what ours differs in, and why
  std::vector<Statement> statements;
};

struct Work {
  std::filesystem::path file;
  std::string id, title, source, doc;
  std::vector<Example> examples;
};

/// Reads a list; references are looked for in the folder above the file's. Throws InputError: file, line, key, also
/// where a case, a reference or a check of that quantity is not there.
Work readWork(const std::filesystem::path& file);

/// The lists of a folder of references, by name; none where it has no folder `examples`.
std::vector<Work> readWorks(const std::filesystem::path& dir);

/// References that the work's statements name, without repetition.
std::vector<std::string> referencesOf(const Work& work);

/// The page. `done` are references whose runs are there, of this call or kept.
std::string formatWork(const Work& work, const std::vector<Verified>& done, const std::string& command);

}  // namespace gambeson::verify
