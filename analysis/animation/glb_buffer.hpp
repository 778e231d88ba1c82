#pragma once
/// The one buffer of a .glb and what describes it: buffer views and accessors.

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace gambeson {

class GlbBuffer {
 public:
  using Json = nlohmann::ordered_json;

  enum Target { none = 0, vertices = 34962, indices = 34963 };
  static constexpr int kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;

  /// What an accessor says beside where it is.
  struct Form {
    int component = kFloat;
    const char* type = "SCALAR";  ///< SCALAR, VEC3, VEC4, MAT4
    int numbers = 1;              ///< of an element
    int stride = 0;               ///< numbers from one element to the next; 0: `numbers`
    bool normalized = false;
    bool bounds = false;  ///< says least and most
  };

  /// Appends a view; later accessors of it follow each other there.
  template <class T>
  int view(std::span<const T> data, Target target, int stride_bytes = 0) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    Json v{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", data.size_bytes()}};
    if (stride_bytes > 0) v["byteStride"] = stride_bytes;
    if (target != none) v["target"] = static_cast<int>(target);
    views_.push_back(std::move(v));
    bytes_.append(reinterpret_cast<const char*>(data.data()), data.size_bytes());
    return static_cast<int>(views_.size()) - 1;
  }

  /// An accessor of `count` elements of a view, whose numbers are `data` (for its bounds), `offset_bytes` into it.
  template <class T>
  int accessor(int view, std::span<const T> data, std::size_t count, const Form& form, std::size_t offset_bytes = 0) {
    Json a{{"bufferView", view},
           {"byteOffset", offset_bytes},
           {"componentType", form.component},
           {"count", count},
           {"type", form.type}};
    if (form.normalized) a["normalized"] = true;
    if (form.bounds) {
      const auto stride = static_cast<std::size_t>(form.stride > 0 ? form.stride : form.numbers);
      std::vector<T> least(data.begin(), data.begin() + form.numbers), most = least;
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < least.size(); ++k) {
          const T value = data[i * stride + k];
          if (value < least[k]) least[k] = value;
          if (value > most[k]) most[k] = value;
        }
      a["min"] = least;
      a["max"] = most;
    }
    accessors_.push_back(std::move(a));
    return static_cast<int>(accessors_.size()) - 1;
  }

  /// Both, of data that are one accessor.
  template <class T>
  int put(const std::vector<T>& data, Target target, const Form& form) {
    const auto numbers = static_cast<std::size_t>(form.stride > 0 ? form.stride : form.numbers);
    const int stride = target == vertices ? static_cast<int>(numbers * sizeof(T)) : 0;
    const std::span<const T> all(data);
    return accessor(view(all, target, stride), all, data.size() / numbers, form);
  }

  const Json& views() const { return views_; }
  const Json& accessors() const { return accessors_; }
  std::string& bytes() { return bytes_; }

 private:
  std::string bytes_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

}  // namespace gambeson
