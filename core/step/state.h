#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace pastefit {

// A state as bytes, for the same program on the same kind of machine. What belongs to it is said once for both ways, by
// a member `serialize(archive)`, which calls `archive(member, member, ...)`; numbers and plain structs are taken as
// they lie in memory, vectors with their length.

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
  void put_bytes(const void* from, std::size_t size) { bytes_.append(static_cast<const char*>(from), size); }

  std::string bytes_;
};

/// Reads it back into the same things in the same order. Requirement: what `StateWriter` wrote of them.
class StateReader {
 public:
  explicit StateReader(std::string_view bytes) : left_(bytes) {}
  template <class... Parts>
  void operator()(Parts&... parts) {
    (take(parts), ...);
  }

 private:
  template <class Part>
  void take(Part& part) {
    if constexpr (requires { part.serialize(*this); }) {
      part.serialize(*this);
    } else if constexpr (requires { part.resize(0); }) {
      auto size = part.size();
      take(size);
      if (size > left_.size()) throw std::logic_error("a state is not that of this run");
      part.resize(size);
      if constexpr (std::is_trivially_copyable_v<typename Part::value_type>)
        take_bytes(part.data(), size * sizeof(typename Part::value_type));
      else
        for (auto& element : part) take(element);
    } else {
      take_bytes(&part, sizeof part);
    }
  }
  void take_bytes(void* to, std::size_t size) {
    if (size > left_.size()) throw std::logic_error("a state is not that of this run");
    if (size > 0) std::memcpy(to, left_.data(), size);
    left_.remove_prefix(size);
  }

  std::string_view left_;
};

}  // namespace pastefit
