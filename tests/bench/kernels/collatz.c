#include "line.h"

static int32_t kernel(void) {
  LINE int32_t m = 0;
  LINE for (int32_t n = 1; n <= 20000; ++n) {
    LINE int32_t x = n;
    LINE int32_t l = 0;
    do {
      LINE x = x % 2 == 0 ? x / 2 : 3 * x + 1;
      LINE l = l + 1;
      LINE
    } while (x > 1);
    LINE if (l > m)
      m = l;
    LINE
  }
  return m;
}
