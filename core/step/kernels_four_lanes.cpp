#include "core/target.h"

#define PASTEFIT_ISA four_lanes
#define PASTEFIT_ISA_NAME PASTEFIT_FOUR_LANES
#define PASTEFIT_WIDTH 4
#include "core/step/contact_kernel.h"
