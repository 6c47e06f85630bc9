#include <stdint.h>

static int32_t kernel(void) {
  int32_t s = 0;
  for (int32_t a = 1; a <= 2000; ++a)
    for (int32_t b = 1; b <= 1000; ++b) {
      s = s + a * b % 7;
      s = s - b / 3;
    }
  return s;
}
