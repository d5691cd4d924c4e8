#pragma once

#include <concepts>
#include <string_view>

// Properties of a field in a file, other than its variable. Independent of JSON: the LAMMPS style reads the laws by the
// same descriptions (data/lammps/README.md).

namespace pastefit {

/// Largest value of a quantity in a file, so that products of a few quantities stay finite.
inline constexpr double largest_quantity = 1e15;

/// Admissible values of a number, in the unit of its key.
struct Range {
  double smallest = -largest_quantity;
  double largest = largest_quantity;
  bool open = false;          ///< excludes `smallest`
  bool judged_later = false;  ///< checked by `validate` of the whole; the schema has the range, the reader ignores it
};

/// Key of an object, with its meaning for its schema.
struct Key {
  std::string_view name;
  std::string_view meaning = {};
  std::string_view schema = {};  ///< with the words, "laws.schema.json#/properties/normal"; empty: inline

  template <class Name>
  requires std::convertible_to<const Name&, std::string_view> Key(const Name& key, std::string_view in_words = {},
                                                                  std::string_view in_schema = {})
      : name(key), meaning(in_words), schema(in_schema) {}
  operator std::string_view() const { return name; }
};

/// Presence of a key in an object. The alternatives that follow convert to it for a reader.
enum class Need { required, optional };

/// Alternative to `Need`: an optional key that is omitted for the default value, which the variable has before reading.
template <class T>
struct Default {
  T value;
  operator Need() const { return Need::optional; }
};
template <class T>
Default(T) -> Default<T>;

/// Alternative to `Need`: a key that is required and written only together with something else.
struct With {
  bool there;
  operator Need() const { return there ? Need::required : Need::optional; }
};

/// Alternative to `Need`: an optional key that is written only if `holds`.
struct WrittenIf {
  bool holds;
  operator Need() const { return Need::optional; }
};

/// Word in a file, and its value.
template <class T>
struct Named {
  std::string_view name;
  T value;
};

}  // namespace pastefit
