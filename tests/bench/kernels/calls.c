#include "line.h"

static int32_t s, a;

static void three(void) { LINE s = s + 3; LINE }

static void two(void) {
  LINE s = (s + a) & 1023;
  LINE three();
  LINE
}

static void one(void) {
  LINE a = a + 1;
  LINE two();
  LINE three();
  LINE
}

static int32_t kernel(void) {
  LINE LINE for (int32_t i = 1; i <= 300000; ++i) {
    LINE a = i;
    LINE one();
    LINE
  }
  return s;
}
