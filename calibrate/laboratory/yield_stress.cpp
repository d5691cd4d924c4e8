#include "calibrate/laboratory/yield_stress.h"

#include <cmath>
#include <numbers>
#include <string_view>

#include "calibrate/base/statistics.h"
#include "calibrate/base/units.h"

namespace pastefit {

namespace {

constexpr double gravity = 9.81;          // as precise as the theories
constexpr double largest_strength = 100;  // over the yield stress of the height
constexpr std::string_view height_formula = "Schowalter 1998", spread_formula = "Roussel 2005",
                           beyond_spread_formula = "Roussel 2005 (heap not flat)";
constexpr double flat = 1.0 / 3;  // largest height of a flat cake over that of the mould

/// Shear stress at depth z below the top of a frustum, over rho g H; lengths in heights of the mould.
double stress_at(double al, double z) {
  const double wider = 1 + z / al;
  return al / 6 * (wider - 1 / (wider * wider));
}

double kept_share_of_frustum(double al, double stress) {
  if (stress >= stress_at(al, 1)) return 1;
  const double depth = bisected(0, 1, [&](double z) { return stress_at(al, z) < stress; });
  const auto excess = [&](double z) { return std::pow(1 + z / al, 3) - 1; };
  return depth + 2 * stress * std::log(excess(1) / excess(depth));
}

double kept_share_of_cylinder(double stress) {
  return stress >= 0.5 ? 1 : 2 * stress * (1 - std::log(2 * stress));
}

}  // namespace

std::optional<double> kept_height_m(const Mould& mould, double density_kg_m3, double yield_stress_pa) {
  const double stress = yield_stress_pa / (density_kg_m3 * gravity * mould.height_m);
  const double widening = (mould.base_radius_m - mould.top_radius_m) / mould.top_radius_m;
  if (widening < -1e-6) return std::nullopt;
  return mould.height_m *
         (widening < 1e-6 ? kept_share_of_cylinder(stress) : kept_share_of_frustum(1 / widening, stress));
}

std::optional<double> yield_stress_of_height_pa(const Mould& mould, double density_kg_m3, double height_m) {
  const double ample = density_kg_m3 * gravity * mould.height_m;  // twice what supports a cylinder
  const auto most = kept_height_m(mould, density_kg_m3, ample);
  if (!most || !(height_m > 0) || !(height_m < mould.height_m)) return std::nullopt;
  return bisected(0, ample, [&](double pa) { return *kept_height_m(mould, density_kg_m3, pa) < height_m; });
}

double yield_stress_of_spread_pa(double volume_m3, double density_kg_m3, double radius_m) {
  return 225 * density_kg_m3 * gravity * volume_m3 * volume_m3 /
         (128 * std::numbers::pi * std::numbers::pi * std::pow(radius_m, 5));
}

double radius_of_cake_m(double volume_m3, double density_kg_m3, double yield_stress_pa) {
  return std::pow(yield_stress_of_spread_pa(volume_m3, density_kg_m3, 1) / yield_stress_pa, 0.2);
}

std::optional<std::vector<PredictedReading>> readings_of_fluid(const SlumpTest& test, double yield_stress_pa) {
  const double density = test.bulk_density_kg_m3, volume = volume_m3(test.mould);
  std::vector<PredictedReading> out;
  const auto predict = [&](std::string_view key, std::string_view formula, const auto& reading_mm) {
    const double low = reading_mm(yield_stress_pa / kFormulaFactor),
                 high = reading_mm(yield_stress_pa * kFormulaFactor);
    const double deviation = std::abs(high - low) / 2;
    if (deviation > 0) out.push_back({key, formula, reading_mm(yield_stress_pa), deviation});
  };
  if (kept_height_m(test.mould, density, yield_stress_pa))
    predict("step1.height_mm", height_formula, [&](double pa) { return mm * *kept_height_m(test.mould, density, pa); });
  const auto radius_m = [&](double pa) { return radius_of_cake_m(volume, density, pa); };
  const double middle_m = std::sqrt(2 * yield_stress_pa * radius_m(yield_stress_pa) / (density * gravity));
  if (middle_m <= flat * test.mould.height_m)
    predict("step1.spread_mm", spread_formula, [&](double pa) { return 2 * mm * radius_m(pa); });
  return out;
}

std::vector<YieldStress> yield_stresses_of(const SlumpTest& test, const Readings& readings) {
  std::vector<YieldStress> out;
  const double density = test.bulk_density_kg_m3;
  const auto height_mm = readings.find("step1.height_mm");
  if (height_mm)
    if (const auto pa = yield_stress_of_height_pa(test.mould, density, *height_mm / 1e3))
      out.push_back({"step1.height_mm", height_formula, *pa});
  const auto spread_mm = readings.find("step1.spread_mm");
  const bool stands = height_mm && *height_mm > flat * mm * test.mould.height_m;
  if (spread_mm && *spread_mm > 0)
    out.push_back({"step1.spread_mm", stands ? beyond_spread_formula : spread_formula,
                   yield_stress_of_spread_pa(volume_m3(test.mould), density, *spread_mm / 2e3)});
  return out;
}

std::optional<LikelyRange> likely_strength_pa(const SlumpTest& test, const Readings& readings) {
  const auto height_mm = readings.find("step1.height_mm");
  if (!height_mm) return {};
  const auto stress_pa = yield_stress_of_height_pa(test.mould, test.bulk_density_kg_m3, *height_mm / mm);
  if (!stress_pa || *stress_pa <= 0) return {};
  const bool stands = *height_mm > flat * mm * test.mould.height_m;
  return LikelyRange{stands ? *stress_pa : 0, largest_strength * *stress_pa};
}

}  // namespace pastefit
