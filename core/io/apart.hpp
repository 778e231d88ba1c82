#pragma once
/// Reading foreign formats in a process of its own: a file that makes a reader crash, hang or take all memory then ends
/// that process, and not the program.

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/error.hpp"

namespace gambeson {

/// Plain values one after the other, from one process to another of the same program.
class BytesOut {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  void put(const std::string& text) { putAll(text); }
  template <class T>
  void put(const std::vector<T>& list) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      putAll(list);
    } else {
      put(list.size());
      for (const T& item : list) put(item);
    }
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <class List>
  void putAll(const List& list) {
    put(list.size());
    bytes_.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0]));
  }
  std::string bytes_;
};

/// What BytesOut wrote, in the same order. Throws RunError where it is shorter.
class BytesIn {
 public:
  explicit BytesIn(std::string bytes) : bytes_(std::move(bytes)) {}
  template <class T>
  void get(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(&value, take(1, sizeof(T)), sizeof(T));
  }
  void get(std::string& text) {
    const auto n = count();
    text.assign(take(n, 1), n);
  }
  template <class T>
  void get(std::vector<T>& list) {
    const auto n = count();
    if constexpr (std::is_trivially_copyable_v<T>) {
      const char* from = take(n, sizeof(T));
      list.resize(n);
      if (n > 0) std::memcpy(list.data(), from, n * sizeof(T));
    } else {
      list.clear();
      for (std::size_t i = 0; i < n; ++i) get(list.emplace_back());
    }
  }

 private:
  std::size_t count() {
    std::size_t n = 0;
    get(n);
    return n;
  }
  const char* take(std::size_t n, std::size_t size) {
    if (n > (bytes_.size() - at_) / size) throw RunError("a reader's answer is cut off");
    const char* from = bytes_.data() + at_;
    at_ += n * size;
    return from;
  }
  std::string bytes_;
  std::size_t at_ = 0;
};

/// What a reader may use up.
struct ApartLimits {
  std::size_t memory_bytes = std::size_t{768} << 20;  ///< beyond what the program has when the reader starts
  double cpu_s = 10;                                  ///< of the processor; ten times as much by the clock
};

/// The limits for a file of this size: a second more for every 4 MiB.
ApartLimits limitsFor(const std::filesystem::path& file);

/// Runs `read` in a process of its own, split off this one, and returns what it put out. `read` must start no threads;
/// what it prints is dropped.
/// Throws InputError: the one that `read` throws, or one that names `file` where `read` throws something else, crashes,
/// or exceeds the limits. Throws RunError where no process can be started.
BytesIn readApart(const std::filesystem::path& file, const ApartLimits& limits,
                  const std::function<void(BytesOut&)>& read);

}  // namespace gambeson
