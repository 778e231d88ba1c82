#include "core/io/hdf5_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <tuple>

namespace gambeson::hdf5 {
namespace {

constexpr unsigned kDeflateLevel = 2;
constexpr std::size_t kChunkBytes = 1u << 20;
constexpr std::size_t kLongestName = 1000;

/// HDF5 prints its error stack by default; here the stack becomes the text of the exception.
void silenceLibrary() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

/// The innermost entry of HDF5's error stack, cleared after.
std::string libraryReason() {
  std::string reason;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned n, const H5E_error2_t* e, void* out) -> herr_t {
        if (n == 0 && e->desc) *static_cast<std::string*>(out) = e->desc;
        return 0;
      },
      &reason);
  H5Eclear2(H5E_DEFAULT);
  return reason.empty() ? "" : " (" + reason + ")";
}

void check(herr_t status, const std::string& what) {
  if (status < 0) throw Error(what + libraryReason());
}

/// The core driver's memory is a std::string that outlives the file: H5Fclose leaves the whole file in it.
/// (H5Fget_file_image clears a flag in the superblock without renewing its checksum, so the bytes it gives cannot be
/// opened again.)
void keepMemoryIn(std::string* memory, hid_t access) {
  H5FD_file_image_callbacks_t calls{};
  calls.image_realloc = [](void*, size_t size, H5FD_file_image_op_t, void* udata) -> void* {
    auto* bytes = static_cast<std::string*>(udata);
    try {
      bytes->resize(size);
    } catch (const std::exception&) {
      return nullptr;
    }
    return bytes->data();
  };
  calls.image_free = [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; };
  calls.udata_copy = [](void* udata) -> void* { return udata; };
  calls.udata_free = [](void*) -> herr_t { return 0; };
  calls.udata = memory;
  check(H5Pset_file_image_callbacks(access, &calls), "file in memory");
}

hid_t newFile(std::string* memory) {
  silenceLibrary();
  // No time stamps, and links in the order of their creation: the same content gives the same bytes.
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "property list");
  check(H5Pset_obj_track_times(creation, false), "times");
  check(H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), "link order");
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "property list");
  check(H5Pset_fapl_core(access, kChunkBytes, false), "file in memory");
  check(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110), "format version");
  keepMemoryIn(memory, access);
  // Two of one name would be one file to the library; what a file is called stands nowhere in it.
  return H5Fcreate(fmt::format("gambeson-in-memory-{}", fmt::ptr(memory)).c_str(), H5F_ACC_TRUNC, creation, access);
}

Handle textType(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "text type");
  check(H5Tset_size(type, std::max<std::size_t>(length, 1)), "text type");
  check(H5Tset_strpad(type, H5T_STR_NULLPAD), "text type");
  return type;
}

std::string trimmed(const char* data, std::size_t size) {
  while (size > 0 && data[size - 1] == '\0') --size;
  return {data, size};
}

bool plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

}  // namespace

bool takesThreads() {
  hbool_t safe = false;
  return H5is_library_threadsafe(&safe) >= 0 && safe;
}

Handle::Handle(hid_t id, herr_t (*closer)(hid_t), const char* what) : id_(id), close_(closer) {
  if (id < 0) throw Error(what + libraryReason());
}

Handle::~Handle() {
  if (id_ >= 0) close_(id_);
}

herr_t Handle::close() {
  const hid_t id = id_;
  id_ = -1;
  return close_(id);
}

std::string linkName(const std::string& text) {
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (plain(c) || (c == '.' && i > 0)) {
      name += c;
      continue;
    }
    constexpr char digits[] = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    name += {'%', digits[byte >> 4], digits[byte & 15]};
  }
  if (name.size() > kLongestName) throw Error("the name " + text + " is too long");
  return name.empty() ? "%" : name;
}

std::string fromLinkName(const std::string& name) {
  if (name == "%") return "";
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] != '%') {
      text += name[i];
      continue;
    }
    int byte = 0;
    const char* first = name.data() + i + 1;
    if (i + 2 >= name.size() || std::from_chars(first, first + 2, byte, 16).ptr != first + 2)
      throw Error("bad name " + name);
    text += static_cast<char>(byte);
    i += 2;
  }
  return text;
}

Builder::Builder()
    : memory_(std::make_unique<std::string>()), file_(newFile(memory_.get()), H5Fclose, "file in memory") {}

void Builder::group(const std::string& path) {
  const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "property list");
  check(H5Pset_obj_track_times(creation, false), "times");
  check(H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), "link order");
  const Handle made(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose, path.c_str());
}

void Builder::dataset(const std::string& path, hid_t memory, hid_t file, const void* data, std::size_t size,
                      std::size_t columns) {
  const std::size_t width = columns == 0 ? 1 : columns, item = H5Tget_size(file);
  if (size % width != 0)
    throw Error(path + ": " + std::to_string(size) + " values in rows of " + std::to_string(width));
  const hsize_t dims[2] = {size / width, width};
  const int rank = columns == 0 ? 1 : 2;
  const Handle space(H5Screate_simple(rank, dims, nullptr), H5Sclose, path.c_str());
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "property list");
  check(H5Pset_obj_track_times(creation, false), "times");
  if (size > 0) {  // an empty array has no chunks
    const hsize_t most = std::max<std::size_t>(1, kChunkBytes / (item * width));
    const hsize_t chunk[2] = {std::min(dims[0], most), width};
    check(H5Pset_chunk(creation, rank, chunk), path);
    check(H5Pset_shuffle(creation), path);
    check(H5Pset_deflate(creation, kDeflateLevel), path);  // every chunk gets zlib's Adler-32 with it
  }
  const Handle set(H5Dcreate2(file_, path.c_str(), file, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
                   path.c_str());
  if (size > 0) check(H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), path);
}

void Builder::array(const std::string& path, std::span<const float> v, std::size_t columns) {
  dataset(path, H5T_NATIVE_FLOAT, H5T_IEEE_F32LE, v.data(), v.size(), columns);
}
void Builder::array(const std::string& path, std::span<const double> v, std::size_t columns) {
  dataset(path, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, v.data(), v.size(), columns);
}
void Builder::array(const std::string& path, std::span<const int> v, std::size_t columns) {
  dataset(path, H5T_NATIVE_INT, H5T_STD_I32LE, v.data(), v.size(), columns);
}
void Builder::array(const std::string& path, std::span<const std::int64_t> v, std::size_t columns) {
  dataset(path, H5T_NATIVE_INT64, H5T_STD_I64LE, v.data(), v.size(), columns);
}

void Builder::texts(const std::string& path, const std::vector<std::string>& values) {
  std::size_t length = 1;
  for (const auto& v : values) length = std::max(length, v.size());
  std::string packed(length * values.size(), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) values[i].copy(packed.data() + i * length, length);
  const Handle type = textType(length);
  dataset(path, type, type, packed.data(), values.size(), 0);
}

void Builder::attribute(const std::string& path, const std::string& name, const std::string& value) {
  const Handle type = textType(value.size());
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "attribute");
  const Handle a(
      H5Acreate_by_name(file_, path.c_str(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose, name.c_str());
  check(H5Awrite(a, type, value.empty() ? "" : value.data()), name);
}

void Builder::attribute(const std::string& path, const std::string& name, std::int64_t value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "attribute");
  const Handle a(
      H5Acreate_by_name(file_, path.c_str(), name.c_str(), H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose, name.c_str());
  check(H5Awrite(a, H5T_NATIVE_INT64, &value), name);
}

std::string Builder::finish() {
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "flush");
  check(file_.close(), "close");
  // The memory grows by blocks; where the file ends stands in its superblock (HDF5 file format 3.0, II.A, version 2 and
  // 3: version in byte 8, size of offsets in byte 9, end-of-file address from byte 28, little endian).
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint64_t>(static_cast<unsigned char>((*memory_)[i]));
  };
  if (memory_->size() < 48 || byte(8) < 2 || byte(8) > 3 || byte(9) != 8) throw Error("unknown superblock");
  std::uint64_t end = 0;
  for (std::size_t i = 0; i < 8; ++i) end |= byte(28 + i) << (8 * i);
  if (end > memory_->size()) throw Error("the file in memory is incomplete");
  memory_->resize(end);
  return std::move(*memory_);
}

namespace {

Handle openFile(const std::filesystem::path& path) {
  silenceLibrary();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "property list");
  // Closed segments never change: no lock is needed, and network file systems often refuse one.
  check(H5Pset_file_locking(access, false, true), "locking");
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose, "not a whole HDF5 file"};
}

Handle openSet(hid_t file, const std::string& path) {
  return {H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, path.c_str()};
}

std::pair<std::size_t, std::size_t> shapeOf(hid_t set, const std::string& path) {
  const Handle space(H5Dget_space(set), H5Sclose, path.c_str());
  hsize_t dims[2] = {0, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1 || rank > 2) throw Error(path + ": has " + std::to_string(rank) + " dimensions");
  H5Sget_simple_extent_dims(space, dims, nullptr);
  return {dims[0], dims[1]};
}

}  // namespace

File::File(const std::filesystem::path& path) : file_(openFile(path)) {}

std::vector<std::string> File::names(const std::string& group) const {
  const Handle g(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose, group.c_str());
  H5G_info_t info;
  check(H5Gget_info(g, &info), group);
  std::vector<std::string> result;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    char name[kLongestName + 2];
    const ssize_t n = H5Lget_name_by_idx(g, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i, name, sizeof name, H5P_DEFAULT);
    if (n <= 0 || n >= static_cast<ssize_t>(sizeof name)) throw Error(group + libraryReason());
    result.emplace_back(name, static_cast<std::size_t>(n));
  }
  return result;
}

template <class T>
Array<T> File::read(const std::string& path, hid_t memory, hid_t file) const {
  const Handle set = openSet(file_, path);
  const Handle type(H5Dget_type(set), H5Tclose, path.c_str());
  if (H5Tequal(type, file) <= 0) throw Error(path + ": numbers of another type");
  Array<T> array;
  std::tie(array.rows, array.columns) = shapeOf(set, path);
  array.values.resize(array.rows * array.columns);
  if (!array.values.empty()) check(H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()), path);
  return array;
}

Array<float> File::floats(const std::string& path) const { return read<float>(path, H5T_NATIVE_FLOAT, H5T_IEEE_F32LE); }
Array<double> File::doubles(const std::string& path) const {
  return read<double>(path, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE);
}
Array<int> File::ints(const std::string& path) const { return read<int>(path, H5T_NATIVE_INT, H5T_STD_I32LE); }
Array<std::int64_t> File::longs(const std::string& path) const {
  return read<std::int64_t>(path, H5T_NATIVE_INT64, H5T_STD_I64LE);
}

std::vector<std::string> File::texts(const std::string& path) const {
  const Handle set = openSet(file_, path);
  const Handle type(H5Dget_type(set), H5Tclose, path.c_str());
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) throw Error(path + ": not texts");
  const std::size_t length = H5Tget_size(type), count = shapeOf(set, path).first;
  std::string packed(length * count, '\0');
  if (count > 0) check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, packed.data()), path);
  std::vector<std::string> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(trimmed(packed.data() + i * length, length));
  return values;
}

std::pair<std::size_t, std::size_t> File::shape(const std::string& path) const {
  return shapeOf(openSet(file_, path), path);
}

std::string File::textAttribute(const std::string& path, const std::string& name) const {
  const Handle a(H5Aopen_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name.c_str());
  const Handle type(H5Aget_type(a), H5Tclose, name.c_str());
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) throw Error(name + ": not a text");
  std::string value(H5Tget_size(type), '\0');
  check(H5Aread(a, type, value.data()), name);
  return trimmed(value.data(), value.size());
}

std::int64_t File::intAttribute(const std::string& path, const std::string& name) const {
  const Handle a(H5Aopen_by_name(file_, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name.c_str());
  const Handle type(H5Aget_type(a), H5Tclose, name.c_str());
  if (H5Tequal(type, H5T_STD_I64LE) <= 0) throw Error(name + ": not an integer");
  std::int64_t value = 0;
  check(H5Aread(a, H5T_NATIVE_INT64, &value), name);
  return value;
}

}  // namespace gambeson::hdf5
