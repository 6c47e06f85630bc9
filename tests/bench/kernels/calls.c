#include <stdint.h>

static int32_t s, a;

static void three(void) { s = s + 3; }

static void two(void) {
  s = (s + a) & 1023;
  three();
}

static void one(void) {
  a = a + 1;
  two();
  three();
}

static int32_t kernel(void) {
  for (int32_t i = 1; i <= 300000; ++i) {
    a = i;
    one();
  }
  return s;
}
