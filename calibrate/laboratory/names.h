#pragma once

#include <array>
#include <string>
#include <type_traits>

#include "calibrate/base/json_reader.h"
#include "core/laws/table.h"

namespace pastefit {

// The words of all files for the choices of a test: one row for one value.

inline constexpr std::array<Named<SizeDistribution>, 3> size_distributions{
    {{"mono", SizeDistribution::mono}, {"uniform", SizeDistribution::uniform}, {"normal", SizeDistribution::normal}}};

/// Laws bring their words with them.
template <class... Laws>
constexpr auto describe(TypeList<Laws...>) {
  return std::array{Named<std::remove_const_t<decltype(Laws::choice)>>{Laws::word, Laws::choice}...};
}

inline constexpr auto normal_laws = describe(NormalLaws{});
inline constexpr auto bridge_shapes = describe(Attractions{});
inline constexpr auto rolling_models = describe(RollingLaws{});

inline constexpr std::array<Named<BridgeFormation>, 2> bridge_formations{
    {{"film", BridgeFormation::film}, {"touch", BridgeFormation::touch}}};

inline constexpr std::array<Named<FrictionBasis>, 3> friction_bases{
    {{"elastic", FrictionBasis::elastic}, {"total", FrictionBasis::total}, {"net", FrictionBasis::net}}};

/// The word for a choice of a test.
template <class T, std::size_t N>
std::string word_of(T value, const std::array<Named<T>, N>& words) {
  for (const auto& word : words)
    if (word.value == value) return std::string(word.name);
  return "?";
}

}  // namespace pastefit
