#pragma once

#include <string_view>
#include <vector>

#include "core/laws/materials.h"
#include "core/result.h"

namespace pastefit {

/// The laws that a target can express. A law that is added later is not among them until its exporter says so.
struct KnownLaws {
  std::string_view target;  ///< as people call it
  std::vector<NormalLaw> normal{NormalLaw::hertz};
  std::vector<RollingModel> rolling{RollingModel::none, RollingModel::spring_dashpot};
  std::vector<BridgeShape> attraction = {};  ///< empty: whatever the curve, as a table or a fit
  bool viscosity = false;                    ///< lubrication by the liquid of a bridge
};

inline const std::vector<NormalLaw> kAllNormal{NormalLaw::hertz, NormalLaw::jkr, NormalLaw::dmt,
                                               NormalLaw::sjkr,  NormalLaw::epa, NormalLaw::luding};
inline const std::vector<RollingModel> kAllRolling{RollingModel::none, RollingModel::spring_dashpot,
                                                   RollingModel::constant_torque};
inline const std::vector<BridgeShape> kAllAttractions{BridgeShape::none, BridgeShape::polynomial, BridgeShape::linear,
                                                      BridgeShape::exponential, BridgeShape::capillary};

/// A fault for each law of the contact that is not known.
Faults unknown_laws(const ContactModel& contact, const KnownLaws& known);

}  // namespace pastefit
