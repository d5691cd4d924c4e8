#pragma once

#include <optional>
#include <vector>

#include "calibrate/laboratory/default_answers.h"
#include "core/apparatus/slump/slump_test.h"
#include "core/observe/readings.h"

namespace pastefit {

/// Height [m] of a heap of yield-stress fluid after lifting the mould: its layers widen until the largest shear stress
/// equals the yield stress. Requirement: every number is positive. In units of the mould's height H, with T = yield
/// stress/(rho g H):
///     frustum, al = r_t/(r_b - r_t): T = (al/6)[(1 + h0/al) - (1 + h0/al)^-2], h0: unyielded top,
///         h1 = 2 T ln{[(1 + 1/al)^3 - 1]/[(1 + h0/al)^3 - 1]}, h1: yielded rest;
///     cylinder: h0 = 2 T, h1 = -2 T ln(2 T).
/// Sources: Schowalter & Christensen, J. Rheol. 42 (1998) 865, after Murata 1984 and Christensen 1991; cylinder:
/// Pashias et al., J. Rheol. 40 (1996) 1179. Limits: no friction on the table, no inertia. Nothing for a mould that is
/// wider at its top.
std::optional<double> kept_height_m(const Mould& mould, double density_kg_m3, double yield_stress_pa);

/// Inverse of `kept_height_m`: yield stress [Pa] for this height, by bisection. Nothing if the heap is flat or as high
/// as the mould, or if the mould is wider at its top.
std::optional<double> yield_stress_of_height_pa(const Mould& mould, double density_kg_m3, double height_m);

/// Yield stress [Pa] of a fluid that has spread to a flat cake: 225 rho g V^2/(128 pi^2 R^5). Requirement: every number
/// is positive. Source: Roussel & Coussot, J. Rheol. 49 (2005) 705. Limit: exact as height over radius goes to 0; not
/// valid for heaps as high as a cone.
double yield_stress_of_spread_pa(double volume_m3, double density_kg_m3, double radius_m);

/// Inverse of `yield_stress_of_spread_pa`: radius [m] of the cake.
double radius_of_cake_m(double volume_m3, double density_kg_m3, double yield_stress_pa);

/// Factor between the yield stress of these formulas and a measured one, as one standard deviation. Published relations
/// of yield stress and slump of concretes in the Abrams cone (Hu; Ferraris & de Larrard 1998, some 80 mixes by
/// rheometer; Roussel 2006, simulated) give 1.8 to 3.3 times the value of the height formula, for slumps from 50 to 200
/// mm (tests/calibrate/laboratory/yield_stress_test.cpp). For mine pastes, slump tests give more than a vane (Moghaddam
/// & Hassani, 9th Int. Symp. on Mining with Backfill, 2007). No usable data were found for the spread; it gets the same
/// factor.
inline constexpr double kFormulaFactor = 3;

/// Height after the lift by `kept_height_m`, unless it is the mould's at both ends, and spread if the cake is flat. The
/// deviation of each is half of the difference between yield stresses `kFormulaFactor` times as large and as small.
/// Flat: at most a third of the mould's height in the middle (Roussel, Stefani & Leroy 2005 accept spreads for slumps
/// above 200 mm of the Abrams cone's 300).
std::optional<std::vector<PredictedReading>> readings_of_fluid(const SlumpTest& test, double yield_stress_pa);

/// Yield stresses from height and spread after the lift, each by its formula, as far as they were read. The result of
/// the spread is marked if the heap is known to be higher than a third of its mould, since its formula is for flat
/// cakes.
std::vector<YieldStress> yield_stresses_of(const SlumpTest& test, const Readings& readings);

/// Probable range of the attraction at touch over R^2 for the height read: from the yield stress of that height to a
/// hundred times as much. No lower end for heaps no higher than a third of the mould, which friction alone may support.
/// Derivation: by Rumpf (Agglomeration, 1962), a packing of solid fraction 0.6 with six bridges per grain has a tensile
/// strength of 0.3 of the attraction over R^2, and a yielding fluid's shear stress is half of that: seven times. Data:
/// of 4,504 heaps above a third of an Abrams cone with a tough bridge, 95 % had 2.9 to 7.5 times
/// (tests/results/search.md); a weak bridge, which falls linearly to 0, needs 7 to 17 times. Nothing if the formula has
/// no solution.
std::optional<LikelyRange> likely_strength_pa(const SlumpTest& test, const Readings& readings);

}  // namespace pastefit
