#include <stdint.h>

static int32_t kernel(void) {
  static int32_t z[26];
  int32_t s = 7;
  int32_t t = 0;
  for (int32_t r = 1; r <= 3000; ++r) {
    for (int32_t y = 1; y <= 25; ++y) {
      s = (s * 75 + 74) % 65537;
      z[y] = s;
    }
    for (int32_t i = 2; i <= 25; ++i) {
      const int32_t v = z[i];
      int32_t j = i - 1;
      do {
        if (z[j] < v)
          break;
        z[j + 1] = z[j];
        j = j - 1;
      } while (j > 0);
      z[j + 1] = v;
    }
    t = (t + z[13]) % 65537;
  }
  return t;
}
