#pragma once

#include <string_view>

// What is said of a field of a file beside its name and its variable. Knows nothing of JSON: the style for LAMMPS reads
// the laws by the same descriptions (data/lammps/README.md).

namespace pastefit {

/// No quantity of a file is larger: squares and products of a few of them stay finite.
inline constexpr double largest_quantity = 1e15;

/// The admissible values of a number, in the unit of its key.
struct Range {
  double smallest = -largest_quantity;
  double largest = largest_quantity;
  bool open = false;  ///< `smallest` itself is refused
};

/// Whether an object must have the key.
enum class Need { required, optional };

/// In the place of `Need`: an optional key that is left out where its value is the default one, which the variable has
/// before it is read.
template <class T>
struct Default {
  T value;
};
template <class T>
Default(T) -> Default<T>;

/// A word of a file and the value it stands for.
template <class T>
struct Named {
  std::string_view name;
  T value;
};

}  // namespace pastefit
