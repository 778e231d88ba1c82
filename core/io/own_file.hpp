#pragma once
/// Files that this program writes, and the rule that it replaces no others.
///
/// Every folder that something is written into has a list, `.gambeson`: one line for each file, its size and a hash of
/// its content, entered (and on the disk) before the file is put into its place. A file is our own where it is a regular
/// file, is listed there and has a content that is listed. So what a user put there, edited or linked is never ours,
/// whatever it is called and whenever the program was killed; a copied folder, list and all, stays ours. A folder without
/// a list (of a version before there were lists, say) holds nothing of ours. Removing a list is safe: then nothing there
/// is replaced any more.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace gambeson {

/// Name of the list.
inline constexpr std::string_view kOwnFiles = ".gambeson";

/// Why nothing can be written at `file`: something is there that is not our own (a symbolic link, a folder, a file that
/// is not listed or was changed). Empty where nothing or an own file is there.
std::string inTheWay(const std::filesystem::path& file);

/// Whether an own file stands there.
bool isOwnFile(const std::filesystem::path& file);

/// Throws InputError at `where` with the file and the reason where inTheWay gives one: for what is checked before
/// anything is computed.
void requireFree(const std::filesystem::path& file, const InputError::Where& where);

/// Enters the file and replaces it atomically (writeFileAtomically). Throws InputError where something else is in the
/// way, which stays as it is; RunError where the file system fails.
void writeOwnFile(const std::filesystem::path& file, std::string_view content);

/// Enters a file that something else will write into (the log of a process): its content is not looked at from now on.
/// Makes it where it is missing. Throws as writeOwnFile.
void claimFile(const std::filesystem::path& file);

/// Removes an own file; leaves everything else. Throws RunError where the file system fails.
void removeOwnFile(const std::filesystem::path& file);

/// Own files of a folder, by name.
std::vector<std::filesystem::path> ownFiles(const std::filesystem::path& folder);

}  // namespace gambeson
