// Marks the beginning of a line of orbBasic in a kernel in C. With -DCOUNTED each line is counted
// and may be the last, as in the ball.
#include <stdint.h>
#include <stdlib.h>

#ifdef COUNTED
static int64_t budget = INT64_MAX;
#define LINE                                                                                       \
  if (__builtin_expect(--budget < 0, 0))                                                           \
    abort();
#else
#define LINE
#endif
