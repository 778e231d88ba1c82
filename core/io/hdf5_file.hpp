#pragma once
/// The little of HDF5 that a recording needs: arrays, texts and attributes, compressed, checksummed, and with the same
/// bytes for the same content. Internal to core/io. Format of HDF5 1.10: its metadata carry checksums too.

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gambeson::hdf5 {

/// What the HDF5 library says went wrong.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Whether the library may be called by several threads at once.
bool takesThreads();

/// Owns an identifier of HDF5. Constructed from what the library returned; a negative one throws Error.
class Handle {
 public:
  Handle(hid_t id, herr_t (*closer)(hid_t), const char* what);
  Handle(Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle();
  herr_t close();
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Any text as the name of one link: bytes other than letters, digits, '_' and '-' (and '.' inside a name) become %XX.
std::string linkName(const std::string& text);
std::string fromLinkName(const std::string& name);

/// A file built in memory; its image is written by the caller.
class Builder {
 public:
  Builder();

  void group(const std::string& path);
  /// Rows of `columns` values (columns 0: a one-dimensional array). Shuffle and deflate 2, whose stream carries
  /// an Adler-32 checksum.
  void array(const std::string& path, std::span<const float> values, std::size_t columns = 0);
  void array(const std::string& path, std::span<const double> values, std::size_t columns = 0);
  void array(const std::string& path, std::span<const int> values, std::size_t columns = 0);
  void array(const std::string& path, std::span<const std::int64_t> values, std::size_t columns = 0);
  void texts(const std::string& path, const std::vector<std::string>& values);
  void attribute(const std::string& path, const std::string& name, const std::string& value);
  void attribute(const std::string& path, const std::string& name, std::int64_t value);
  /// Closes the file and gives its bytes; nothing can be added after.
  std::string finish();

 private:
  void dataset(const std::string& path, hid_t memory, hid_t file, const void* data, std::size_t size,
               std::size_t columns);
  std::unique_ptr<std::string> memory_;  // before file_, which writes to it until it is closed
  Handle file_;
};

/// An array read back: `rows` x `columns` (columns 1 for a one-dimensional one).
template <class T>
struct Array {
  std::size_t rows = 0, columns = 1;
  std::vector<T> values;
};

/// A file to read. Every member throws Error where what it asks for is absent or damaged.
class File {
 public:
  explicit File(const std::filesystem::path& path);

  /// The (encoded) names in a group, in the order of their creation.
  std::vector<std::string> names(const std::string& group) const;
  Array<float> floats(const std::string& path) const;
  Array<double> doubles(const std::string& path) const;
  Array<int> ints(const std::string& path) const;
  Array<std::int64_t> longs(const std::string& path) const;
  std::vector<std::string> texts(const std::string& path) const;
  /// Rows and columns of an array without reading it.
  std::pair<std::size_t, std::size_t> shape(const std::string& path) const;
  std::string textAttribute(const std::string& path, const std::string& name) const;
  std::int64_t intAttribute(const std::string& path, const std::string& name) const;

 private:
  template <class T>
  Array<T> read(const std::string& path, hid_t memory, hid_t file) const;
  Handle file_;
};

}  // namespace gambeson::hdf5
