#pragma once

#include <array>

#include "calibrate/study/json_reader.h"
#include "calibrate/study/study.h"
#include "core/rigs/slump/slump_test.h"

namespace pastefit {

// The words of all files for the choices of a test: one row for one value.

inline constexpr std::array<Named<SizeDistribution>, 3> size_distributions{
    {{"mono", SizeDistribution::mono}, {"uniform", SizeDistribution::uniform}, {"normal", SizeDistribution::normal}}};

inline constexpr std::array<Named<BridgeShape>, 5> bridge_shapes{{{"none", BridgeShape::none},
                                                                  {"polynomial", BridgeShape::polynomial},
                                                                  {"linear", BridgeShape::linear},
                                                                  {"exponential", BridgeShape::exponential},
                                                                  {"capillary", BridgeShape::capillary}}};

inline constexpr std::array<Named<BridgeFormation>, 2> bridge_formations{
    {{"film", BridgeFormation::film}, {"touch", BridgeFormation::touch}}};

inline constexpr std::array<Named<RollingModel>, 3> rolling_models{
    {{"none", RollingModel::none},
     {"spring_dashpot", RollingModel::spring_dashpot},
     {"constant_torque", RollingModel::constant_torque}}};

inline constexpr std::array<Named<FrictionBasis>, 2> friction_bases{
    {{"elastic", FrictionBasis::elastic}, {"total", FrictionBasis::total}}};

inline constexpr std::array<Named<HeightReading>, 2> height_readings{
    {{"axis", HeightReading::axis}, {"highest", HeightReading::highest}}};

inline constexpr std::array<Named<Scale>, 2> scales{{{"linear", Scale::linear}, {"log", Scale::logarithmic}}};

}  // namespace pastefit
