#include "line.h"

static int32_t kernel(void) {
  LINE int32_t s = 0;
  LINE for (int32_t a = 1; a <= 2000; ++a) {
    LINE for (int32_t b = 1; b <= 1000; ++b) {
      LINE s = s + a * b % 7;
      LINE s = s - b / 3;
      LINE
    }
    LINE
  }
  return s;
}
