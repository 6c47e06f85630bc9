#include "line.h"

static int32_t kernel(void) {
  static int32_t z[26];
  LINE int32_t s = 7;
  int32_t t = 0;
  LINE for (int32_t r = 1; r <= 3000; ++r) {
    LINE for (int32_t y = 1; y <= 25; ++y) {
      LINE s = (s * 75 + 74) % 65537;
      LINE z[y] = s;
      LINE
    }
    LINE for (int32_t i = 2; i <= 25; ++i) {
      LINE LINE const int32_t v = z[i];
      LINE int32_t j = i - 1;
      do {
        LINE LINE LINE if (z[j] < v)
          break;
        LINE LINE z[j + 1] = z[j];
        LINE j = j - 1;
        LINE
      } while (j > 0);
      LINE LINE z[j + 1] = v;
      LINE
    }
    LINE LINE t = (t + z[13]) % 65537;
    LINE
  }
  return t;
}
