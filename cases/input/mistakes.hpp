#pragma once
/// All that is wrong with an input, said at once.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace gambeson {

/// How the reason of a key that an object does not have begins.
inline const std::string kUnknownKey = "unknown key; ";

/// Several mistakes of an input; as an InputError it is the first of them.
class InputErrors : public InputError {
 public:
  /// `all`: at least one, none of which is an InputErrors itself.
  explicit InputErrors(std::vector<InputError> all) : InputError(all.front()), all_(std::move(all)) {}
  const std::vector<InputError>& all() const { return all_; }

 private:
  std::vector<InputError> all_;
};

/// The single mistakes of an error, one or more.
std::vector<InputError> mistakesOf(const InputError& error);

/// Collects mistakes in parts that can be read each by itself. Beyond `most` nothing is read any more: a file of another
/// sort may have a hundred thousand.
class Mistakes {
 public:
  static constexpr std::size_t most = 200;

  void add(const InputError& error);
  /// Whether `read` went without a mistake; one is kept.
  template <class Read>
  bool without(Read&& read) {
    if (full()) return false;
    try {
      read();
      return true;
    } catch (const InputError& error) {
      add(error);
      return false;
    }
  }
  bool full() const { return all_.size() >= most; }
  /// Throws what was collected, if anything, in the order of the lines of each file.
  void say() const;

 private:
  std::vector<InputError> all_;
};

}  // namespace gambeson
