#pragma once

#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace pastefit {

// A state as bytes, for the same program on the same kind of machine. Its parts are listed once for writing and
// reading, by a member `serialize(archive)`, which calls `archive(member, member, ...)`. Numbers and plain structs are
// copied as they are in memory, vectors with their length. Each begins at a multiple of eight bytes, so that eight
// bytes are one double or two floats, never parts of them.
//
// A state comes from a file, which is untrusted. All input is therefore checked: lengths and finiteness here, the other
// assumptions of a step in core/step/state_check.h.

/// Bytes that are no state of the run that reads them. What was read before the error must be discarded.
class BadState : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws `BadState` with this reason unless the condition is true.
inline void demand(bool holds, const char* otherwise) {
  if (!holds) throw BadState(otherwise);
}

/// Number of zero bytes after this size, up to a multiple of eight.
constexpr std::size_t state_padding(std::size_t size) {
  return (8 - size % 8) % 8;
}

/// Writes a state.
class StateWriter {
 public:
  template <class... Parts>
  void operator()(Parts&... parts) {
    (put(parts), ...);
  }
  std::string take() { return std::move(bytes_); }

 private:
  template <class Part>
  void put(Part& part) {
    if constexpr (requires { part.serialize(*this); }) {
      part.serialize(*this);
    } else if constexpr (requires { part.resize(0); }) {
      auto size = part.size();
      put(size);
      if constexpr (std::is_trivially_copyable_v<typename Part::value_type>)
        put_bytes(part.data(), size * sizeof(typename Part::value_type));
      else
        for (auto& element : part) put(element);
    } else {
      static_assert(std::is_trivially_copyable_v<Part>, "says nothing of its state");
      put_bytes(&part, sizeof part);
    }
  }
  void put_bytes(const void* from, std::size_t size) {
    bytes_.append(static_cast<const char*>(from), size);
    bytes_.append(state_padding(size), '\0');
  }

  std::string bytes_;
};

/// Reads a state into the same objects in the same order. Errors: throws `BadState` for too few or too many bytes, and
/// for numbers that are not finite.
class StateReader {
 public:
  explicit StateReader(std::string_view bytes) : left_(bytes) {}
  template <class... Parts>
  void operator()(Parts&... parts) {
    (take(parts), ...);
  }
  /// Call after the last part.
  void end() const { demand(left_.empty(), "it holds more than this run has"); }

 private:
  template <class Part>
  void take(Part& part) {
    if constexpr (requires { part.serialize(*this); }) {
      part.serialize(*this);
    } else if constexpr (requires { part.resize(0); }) {
      auto size = part.size();
      take(size);
      if constexpr (std::is_trivially_copyable_v<typename Part::value_type>) {
        constexpr std::size_t each = sizeof(typename Part::value_type);
        demand(size <= left_.size() / each, kTooShort);
        part.resize(size);
        take_bytes(part.data(), size * each);
      } else {
        part.clear();  // grown while reading: the length is untrusted
        for (; size > 0; --size) take(part.emplace_back());
      }
      if constexpr (std::is_floating_point_v<typename Part::value_type>)
        for (const auto value : part) demand(std::isfinite(value), kNotFinite);
    } else if constexpr (std::is_same_v<Part, bool>) {
      char byte = 0;
      take_bytes(&byte, 1);
      demand(byte == 0 || byte == 1, "a yes or no is neither");
      part = byte == 1;
    } else {
      take_bytes(&part, sizeof part);
      if constexpr (std::is_floating_point_v<Part>) demand(std::isfinite(part), kNotFinite);
    }
  }
  void take_bytes(void* to, std::size_t size) {
    const std::size_t whole = size + state_padding(size);
    demand(whole <= left_.size() && whole >= size, kTooShort);
    if (size > 0) std::memcpy(to, left_.data(), size);
    demand(left_.substr(size, whole - size).find_first_not_of('\0') == std::string_view::npos, "it is out of step");
    left_.remove_prefix(whole);
  }

  static constexpr const char* kTooShort = "it holds less than this run has";
  static constexpr const char* kNotFinite = "a number is not finite";

  std::string_view left_;
};

}  // namespace pastefit
