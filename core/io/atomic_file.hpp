#pragma once
/// Files that are either whole or absent, whatever happens to the writer.

#include <filesystem>
#include <string_view>

namespace gambeson {

/// What an unfinished write leaves beside its target: the target's name with this suffix. A file of such a name is taken
/// for one, and removed by the next write; it is never written through where it is a link.
inline constexpr std::string_view kUnfinishedSuffix = ".gambeson.tmp";

/// Replaces `path` by `content`: writes a temporary file beside it, fsyncs it, renames it over `path`, fsyncs the
/// directory (POSIX rename is atomic: a reader sees the old file or the new one). A symbolic link is followed. One
/// writer per path. Throws RunError with the reason; then the old file is untouched and the temporary one removed.
void writeFileAtomically(const std::filesystem::path& path, std::string_view content);

/// Makes the entries of a directory (made, renamed, removed) survive a power loss. Throws RunError with the reason.
void syncDirectory(const std::filesystem::path& directory);

}  // namespace gambeson
