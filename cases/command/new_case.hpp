#pragma once
/// `gambeson new`: a case from five answers.

#include <filesystem>
#include <iosfwd>
#include <string>

namespace gambeson {

/// The answers; those that are empty were not given.
struct NewCase {
  std::filesystem::path file;  ///< to write
  std::string garment;         ///< shorts, trousers, shirt, sleeves, or a pattern's file
  std::string fabric;          ///< a card of the library, or a card's file
  std::string wearer;          ///< a manikin, or a scan's file
  std::string motion;          ///< stand, walk, stairs, step_over, sit, aim
  std::string cells;           ///< coarse, medium, fine
};

/// Asks for the answers that are missing, each with what it may be and what an empty line takes; one that cannot be is
/// asked for again. Where `in` ends, the rest is what an empty line takes.
void askForCase(NewCase& answers, std::istream& in, std::ostream& out);

/// Writes the case, missing answers as empty lines are, then builds what its run starts from, and says how to go on.
/// Returns the exit status. Throws InputError where an answer cannot be, the file is there already, or the case is not
/// valid on its wearer; the file is left then, to be mended.
int writeNewCase(const NewCase& answers, std::ostream& out);

}  // namespace gambeson
