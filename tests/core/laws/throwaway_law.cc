#include <cstdio>

#include "calibrate/laboratory/names.h"
#include "core/apparatus/impact/impact.h"

using namespace pastefit;

namespace {

/// Two grains that meet head on.
double rebound_speed(NormalLaw law) {
  Impact impact;
  impact.contact.normal = law;
  impact.grains.resize(2);
  impact.grains[0].centre_m = {-0.0101, 0, 0};
  impact.grains[1].centre_m = {0.0101, 0, 0};
  impact.grains[0].velocity_m_s = {1, 0, 0};
  impact.duration_s = 1;
  impact.rebound_gap_m = 1e-4;
  if (!validate(impact).empty()) return -1;
  return simulate(impact).readings.find("relative_speed_m_s").value_or(-1);
}

}  // namespace

int main() {
  const double own = rebound_speed(NormalLaw::throwaway), hertz = rebound_speed(NormalLaw::hertz);
  const bool has_word = word_of(NormalLaw::throwaway, normal_laws) == "throwaway";
  std::printf("files call it \"%s\"; grains rebound at %g m/s, of Hertz at %g\n",
              word_of(NormalLaw::throwaway, normal_laws).c_str(), own, hertz);
  return has_word && own > 0 && own == hertz ? 0 : 1;
}
