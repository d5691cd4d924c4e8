#pragma once

#include <concepts>
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
  bool open = false;          ///< `smallest` itself is refused
  bool judged_later = false;  ///< by the `validate` of what is read; the schema says it, the reader takes any number
};

/// A key of an object, with what stands there in words for people, which its schema tells.
struct Key {
  std::string_view name;
  std::string_view meaning = {};
  std::string_view schema = {};  ///< that has the admissible words, "laws.schema.json#/properties/normal"; empty: this

  template <class Name>
  requires std::convertible_to<const Name&, std::string_view> Key(const Name& key, std::string_view in_words = {},
                                                                  std::string_view in_schema = {})
      : name(key), meaning(in_words), schema(in_schema) {}
  operator std::string_view() const { return name; }
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

/// In the place of `Need`: a key that comes with something else; required and written only if that is there.
struct With {
  bool there;
};

/// In the place of `Need`: an optional key that is written only if this holds.
struct WrittenIf {
  bool holds;
};

/// What a reader makes of any of these.
class Presence {
 public:
  Presence(Need need) : need_(need) {}
  template <class T>
  Presence(const Default<T>&) {}
  Presence(With with) : need_(with.there ? Need::required : Need::optional) {}
  Presence(WrittenIf) {}
  operator Need() const { return need_; }

 private:
  Need need_ = Need::optional;
};

/// A word of a file and the value it stands for.
template <class T>
struct Named {
  std::string_view name;
  T value;
};

}  // namespace pastefit
