#pragma once
/// The two ways in which things go wrong: the user's input (exit 2) and the run (exit 1).

#include <stdexcept>
#include <string>

namespace gambeson {

/// Bad input: says file, line (0 where a file has none), key, value, and what is allowed.
class InputError : public std::runtime_error {
 public:
  struct Where {
    std::string file;
    int line = 0;
    std::string key;
  };
  /// Prints as "file:line: key: reason"; parts that are empty or 0 are left out.
  InputError(const Where& where, const std::string& reason)
      : std::runtime_error(format(where, reason)), where_(where), reason_(reason) {}
  const Where& where() const { return where_; }
  const std::string& reason() const { return reason_; }

 private:
  static std::string format(const Where& w, const std::string& reason) {
    std::string s = w.file;
    if (w.line > 0) s.append(":").append(std::to_string(w.line));  // not "a" + b: GCC 12 warns falsely (bug 105329)
    if (!s.empty()) s.append(": ");
    if (!w.key.empty()) s.append(w.key).append(": ");
    return s.append(reason);
  }
  Where where_;
  std::string reason_;
};

/// The run failed; the message says why and where the results so far are.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace gambeson
