#pragma once

#include <optional>
#include <vector>

#include "calibrate/laboratory/default_answers.h"
#include "core/apparatus/slump/slump_test.h"
#include "core/observe/readings.h"

namespace pastefit {

/// Height that a fluid with a yield stress keeps of a mould [m], if its layers widen until the largest shear stress in
/// them is the yield stress.
/// Requirement: every number is positive. In heights H of the mould, with T = yield stress/(rho g H):
///     frustum, al = r_t/(r_b - r_t): T = (al/6)[(1 + h0/al) - (1 + h0/al)^-2] above which nothing yields,
///         h1 = 2 T ln{[(1 + 1/al)^3 - 1]/[(1 + h0/al)^3 - 1]}, the rest;
///     cylinder: h0 = 2 T, h1 = -2 T ln(2 T).
/// Sources: Schowalter & Christensen, J. Rheol. 42 (1998) 865, as Murata 1984 and Christensen 1991 had it; Pashias et
/// al., J. Rheol. 40 (1996) 1179, for the cylinder. Limits: no friction on the table, no inertia; a mould wider at its
/// top is not of this form, and keeps nothing here.
std::optional<double> kept_height_m(const Mould& mould, double density_kg_m3, double yield_stress_pa);

/// Its inverse: the yield stress [Pa] with which a heap keeps this height, by bisection. Nothing if the heap is as high
/// as its mould, or flat, or the mould is wider at its top.
std::optional<double> yield_stress_of_height_pa(const Mould& mould, double density_kg_m3, double height_m);

/// Yield stress [Pa] of a fluid that has spread to a flat cake: 225 rho g V^2/(128 pi^2 R^5).
/// Requirement: every number is positive. Source: Roussel & Coussot, J. Rheol. 49 (2005) 705. Limit: exact as height
/// over radius goes to 0; heaps that stand as high as a cone are not of this kind.
double yield_stress_of_spread_pa(double volume_m3, double density_kg_m3, double radius_m);

/// Its inverse: radius [m] of the cake that a fluid with this yield stress spreads to.
double radius_of_cake_m(double volume_m3, double density_kg_m3, double yield_stress_pa);

/// By what factor the yield stress of these formulas may differ from a measured one, as one standard deviation. The
/// relations of yield stress and slump of concretes in the Abrams cone (Hu; Ferraris & de Larrard 1998, of some 80
/// mixes by rheometer; Roussel 2006, simulated) say 1.8 to 3.3 times what the formula of the height says, for slumps
/// from 50 to 200 mm (tests/calibrate/laboratory/yield_stress_test.cpp); of mine pastes slump tests say more than a
/// vane (Moghaddam & Hassani, 9th Int. Symp. on Mining with Backfill, 2007). Of the spread nothing was found that
/// could be evaluated; it gets the same.
inline constexpr double kFormulaFactor = 3;

/// The height after the lift by `kept_height_m`, and the spread where the cake is flat; the deviation of each is half
/// of what a yield stress `kFormulaFactor` times as large and as small makes of it. Flat: in the middle no higher than
/// a third of the mould (Roussel, Stefani & Leroy 2005 hold a spread good for slumps above 200 mm of an Abrams cone's
/// 300). No height that would be the mould's at both ends.
std::optional<std::vector<PredictedReading>> readings_of_fluid(const SlumpTest& test, double yield_stress_pa);

/// What height and spread after the lift say, each by its formula, as far as they were read. The formula of the spread
/// is marked where the heap is known to be higher than a third of its mould: it is for flat cakes.
std::vector<YieldStress> yield_stresses_of(const SlumpTest& test, const Readings& readings);

/// The attraction at touch over R^2 with which grains are likely to keep the height that was read, by the yield stress
/// of that height: from this to a hundred times as much, or, of a heap no higher than a third of its mould, which
/// friction may hold up without any, no lower end. Rumpf (Agglomeration, 1962) has the tensile strength of a packing of
/// solid fraction 0.6 with six bridges a grain at 0.3 of the attraction over R^2, and the shear stress of a yielding
/// fluid is half of that: seven times. Of 4,504 heaps above a third of an Abrams cone with a tough bridge 95 % had 2.9
/// to 7.5 times (tests/results/search.md); a weak bridge, which falls straight to 0, needs 7 to 17 times. Nothing
/// where the formula has no answer.
std::optional<LikelyRange> likely_strength_pa(const SlumpTest& test, const Readings& readings);

}  // namespace pastefit
