#include "calibrate/base/freed_memory.h"

#include <cstdlib>  // says whether it is the GNU C library

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace pastefit {

void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // [bytes]; blocks below it are not mapped one by one
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

}  // namespace pastefit
