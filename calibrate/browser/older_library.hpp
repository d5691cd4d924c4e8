#pragma once

// What pastefit uses of the C++20 library and libc++ 13, which Emscripten 3.1.6 comes with, does not have: algorithms
// of std::ranges, std::bit_cast, and std::to_chars and std::from_chars of doubles. The browser's build includes this
// before everything else (calibrate/browser/CMakeLists.txt); with a newer library it is empty.

#include <version>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000

#include <bit>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>
#include <type_traits>

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

/// The shortest text that reads back as the same number: fixed, or with an exponent where that is shorter.
inline to_chars_result to_chars(char* first, char* last, double value) {
  char scientific[32], fixed[400];
  int digits = 0;
  do std::snprintf(scientific, sizeof scientific, "%.*e", digits, value);
  while (std::strtod(scientific, nullptr) != value && ++digits < 17);
  const char* const mark = std::strchr(scientific, 'e');  // none: not finite
  const int exponent = mark ? std::atoi(mark + 1) : 0;
  std::snprintf(fixed, sizeof fixed, "%.*f", digits > exponent ? digits - exponent : 0, value);
  const char* const text = mark && std::strlen(scientific) < std::strlen(fixed) ? scientific : fixed;
  const size_t length = std::strlen(text);
  if (length > static_cast<size_t>(last - first)) return {last, errc::value_too_large};
  std::memcpy(first, text, length);
  return {first + length, errc()};
}

/// As in the "C" locale, which a browser's module never leaves.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  const string text(first, last);
  const size_t sign = text.starts_with('-') ? 1 : 0;
  const bool hexadecimal = text.size() > sign + 1 && text[sign] == '0' && (text[sign + 1] | 0x20) == 'x';
  const bool begins = text.size() > sign && (text[sign] > ' ' && text[sign] != '+' && text[sign] != '-');
  if (!begins) return {first, errc::invalid_argument};
  if (hexadecimal) {
    value = sign ? -0.0 : 0.0;
    return {first + sign + 1, errc()};
  }
  char* end = nullptr;
  const double read = std::strtod(text.c_str(), &end);
  if (end == text.c_str()) return {first, errc::invalid_argument};
  const char* const after = first + (end - text.c_str());
  if (read - read != 0 && text.find_first_of("0123456789") < static_cast<size_t>(end - text.c_str()))
    return {after, errc::result_out_of_range};
  value = read;
  return {after, errc()};
}

}  // namespace std

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace std::ranges {

namespace before_ranges {

/// `predicate` on the projection of a value.
template <class Predicate, class Projection>
auto projected(Predicate& predicate, Projection& projection) {
  return [&](auto&& value) -> bool {
    return std::invoke(predicate, std::invoke(projection, std::forward<decltype(value)>(value)));
  };
}

/// `less` on the projections of two values.
template <class Less, class Projection>
auto projected_less(Less& less, Projection& projection) {
  return [&](auto&& a, auto&& b) -> bool {
    return std::invoke(less, std::invoke(projection, std::forward<decltype(a)>(a)),
                       std::invoke(projection, std::forward<decltype(b)>(b)));
  };
}

template <class Value, class Projection>
auto projected_equals(const Value& value, Projection& projection) {
  return [&](auto&& other) -> bool { return std::invoke(projection, std::forward<decltype(other)>(other)) == value; };
}

}  // namespace before_ranges

template <class Range, class Value, class Projection = std::identity>
auto find(Range&& range, const Value& value, Projection projection = {}) {
  return std::find_if(std::begin(range), std::end(range), before_ranges::projected_equals(value, projection));
}
template <class Range, class Predicate, class Projection = std::identity>
auto find_if(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::find_if(std::begin(range), std::end(range), before_ranges::projected(predicate, projection));
}
template <class Range, class Value, class Projection = std::identity>
auto count(Range&& range, const Value& value, Projection projection = {}) {
  return std::count_if(std::begin(range), std::end(range), before_ranges::projected_equals(value, projection));
}
template <class Range, class Predicate, class Projection = std::identity>
auto count_if(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::count_if(std::begin(range), std::end(range), before_ranges::projected(predicate, projection));
}
template <class Range, class Predicate, class Projection = std::identity>
bool any_of(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::any_of(std::begin(range), std::end(range), before_ranges::projected(predicate, projection));
}
template <class Range, class Predicate, class Projection = std::identity>
bool all_of(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::all_of(std::begin(range), std::end(range), before_ranges::projected(predicate, projection));
}
template <class Range, class Predicate, class Projection = std::identity>
bool none_of(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::none_of(std::begin(range), std::end(range), before_ranges::projected(predicate, projection));
}

template <class Range, class Less = std::less<>, class Projection = std::identity>
auto sort(Range&& range, Less less = {}, Projection projection = {}) {
  std::sort(std::begin(range), std::end(range), before_ranges::projected_less(less, projection));
  return std::end(range);
}
template <class Range, class Less = std::less<>, class Projection = std::identity>
auto stable_sort(Range&& range, Less less = {}, Projection projection = {}) {
  std::stable_sort(std::begin(range), std::end(range), before_ranges::projected_less(less, projection));
  return std::end(range);
}
template <class Range, class Place, class Less = std::less<>, class Projection = std::identity>
auto nth_element(Range&& range, Place place, Less less = {}, Projection projection = {}) {
  std::nth_element(std::begin(range), place, std::end(range), before_ranges::projected_less(less, projection));
  return std::end(range);
}
template <class Range, class Place, class Less = std::less<>, class Projection = std::identity>
auto partial_sort(Range&& range, Place place, Less less = {}, Projection projection = {}) {
  std::partial_sort(std::begin(range), place, std::end(range), before_ranges::projected_less(less, projection));
  return std::end(range);
}
template <class Range, class Less = std::less<>, class Projection = std::identity>
bool is_sorted(Range&& range, Less less = {}, Projection projection = {}) {
  return std::is_sorted(std::begin(range), std::end(range), before_ranges::projected_less(less, projection));
}
template <class Range, class Value, class Less = std::less<>, class Projection = std::identity>
auto lower_bound(Range&& range, const Value& value, Less less = {}, Projection projection = {}) {
  return std::lower_bound(std::begin(range), std::end(range), value, [&](auto&& one, const Value& sought) -> bool {
    return std::invoke(less, std::invoke(projection, std::forward<decltype(one)>(one)), sought);
  });
}

template <class Range, class Less = std::less<>, class Projection = std::identity>
auto max_element(Range&& range, Less less = {}, Projection projection = {}) {
  return std::max_element(std::begin(range), std::end(range), before_ranges::projected_less(less, projection));
}
template <class Range, class Less = std::less<>, class Projection = std::identity>
auto min_element(Range&& range, Less less = {}, Projection projection = {}) {
  return std::min_element(std::begin(range), std::end(range), before_ranges::projected_less(less, projection));
}
template <class Range, class Less = std::less<>, class Projection = std::identity>
auto max(Range&& range, Less less = {}, Projection projection = {}) {
  return *ranges::max_element(range, less, projection);
}
template <class Range, class Less = std::less<>, class Projection = std::identity>
auto min(Range&& range, Less less = {}, Projection projection = {}) {
  return *ranges::min_element(range, less, projection);
}
template <class Value>
struct minmax_result {
  Value min, max;
};
template <class Range>
auto minmax(Range&& range) {
  const auto ends = std::minmax_element(std::begin(range), std::end(range));
  return minmax_result<std::iter_value_t<decltype(ends.first)>>{*ends.first, *ends.second};
}

template <class Range, class Value>
void replace(Range&& range, const Value& old, const Value& other) {
  std::replace(std::begin(range), std::end(range), old, other);
}
template <class Range, class Out>
void copy(Range&& range, Out out) {
  std::copy(std::begin(range), std::end(range), out);
}
template <class Range, class Out, class Predicate>
void copy_if(Range&& range, Out out, Predicate predicate) {
  std::copy_if(std::begin(range), std::end(range), out, predicate);
}
template <class Range, class Out>
void move(Range&& range, Out out) {
  std::move(std::begin(range), std::end(range), out);
}
template <class One, class Other>
bool equal(One&& one, Other&& other) {
  return std::equal(std::begin(one), std::end(one), std::begin(other), std::end(other));
}

}  // namespace std::ranges

#endif
