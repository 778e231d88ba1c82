#pragma once
/// Texts that others wrote, as a terminal may show them.

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace gambeson {

/// A message as the command prints it: of what it quotes ('...') the first 80 bytes, and at most 390 bytes in all, its
/// middle left out where it is longer (the place stands at the start, what is allowed at the end). What a terminal
/// would act on (control characters) and bytes that are no UTF-8 are written as \x1b; line breaks stay.
std::string messageText(std::string_view text);

/// Where this thread's notes go: the standard error, unless a NotesTo says otherwise.
std::FILE* notes();

/// While it lives, what this thread has to say goes there: runs that share a process have logs of their own.
class NotesTo {
 public:
  explicit NotesTo(std::FILE* stream);
  ~NotesTo();
  NotesTo(const NotesTo&) = delete;
  NotesTo& operator=(const NotesTo&) = delete;

 private:
  std::FILE* before_;
};

/// A note, as messageText has it. Names that the input gives stand in notes.
void sayNote(const std::string& note);

/// Why a text cannot be a name or a path: empty where it can. Control characters (line breaks, escapes of terminals,
/// zero bytes) and bytes that are no UTF-8 are refused; `lines`: line breaks and tabs are allowed.
std::string unfitText(std::string_view text, bool lines = false);

/// A path of the command line. Throws InputError ("command line", option) where unfitText does not like it.
void checkPath(const std::filesystem::path& path, const std::string& option);

/// What nlohmann's parser or one of its values complains about, without "[json.exception...]": the key and the reason.
std::string jsonReason(std::string_view what);

}  // namespace gambeson
