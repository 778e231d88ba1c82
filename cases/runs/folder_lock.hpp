#pragma once
/// One command at a time writes into a folder.

#include <filesystem>

namespace gambeson {

/// Holds DIR/.lock while it lives. Processes that inherit the descriptor hold it too: while one of them lives, whatever
/// became of the command that started it, the folder is taken.
class FolderLock {
 public:
  /// Waits some seconds for processes that are just dying; throws InputError ("command line", "--out") where the folder
  /// is taken or cannot be written.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  int descriptor() const { return descriptor_; }

  static constexpr const char* file = ".lock";

 private:
  int descriptor_ = -1;
};

}  // namespace gambeson
