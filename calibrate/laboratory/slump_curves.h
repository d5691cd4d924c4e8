#pragma once

#include <span>

#include "calibrate/laboratory/measurement.h"
#include "core/apparatus/slump/slump_test.h"

namespace pastefit {

/// Outlines and spread curves of a slump test that are in another frame or unit than the files': off a picture's edge,
/// downwards, in centimetres, as a radius. Adds a fault for each.
void check_curves(const SlumpTest& test, ReadingCheck& check);

}  // namespace pastefit
