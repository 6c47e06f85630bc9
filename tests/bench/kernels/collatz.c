#include <stdint.h>

static int32_t kernel(void) {
  int32_t m = 0;
  for (int32_t n = 1; n <= 20000; ++n) {
    int32_t x = n;
    int32_t l = 0;
    do {
      x = x % 2 == 0 ? x / 2 : 3 * x + 1;
      l = l + 1;
    } while (x > 1);
    if (l > m)
      m = l;
  }
  return m;
}
