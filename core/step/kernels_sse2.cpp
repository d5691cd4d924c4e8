#define PASTEFIT_ISA sse2
#define PASTEFIT_ISA_NAME "SSE2"
#define PASTEFIT_WIDTH 4
#include "core/step/contact_kernel.h"
