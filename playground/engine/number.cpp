// How numbers with decimals are read on the page: JavaScript reads them as C does, and is there
// already. The one of C's library weighs 5 KB more on the way to a visitor, most of it for numbers
// of 128 bits that nobody asks for.

#include <emscripten.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

// The value of the decimal number at `text`, whose length is written to `length`: 0 where there is
// none. What follows is JavaScript.
// clang-format off
EM_JS(double, read_number, (const char* text, int* length), {
  let end = text;
  while (HEAPU8[end]) ++end;
  const digits = new RegExp('^([-+]?([0-9]+[.]?[0-9]*|[.][0-9]+)(e[-+]?[0-9]+)?)?', 'i')
    .exec(new TextDecoder().decode(HEAPU8.subarray(text, end)))[0];
  HEAP32[length >> 2] = digits.length;
  return Number(digits);
})
// clang-format on

/// Stands in for C's strtod (the linker's --wrap): `number` at the beginning of `text`, where it
/// ends in `end`; ERANGE where it is too large or too small.
extern "C" double __wrap_strtod(const char* text, char** end) {
  int length = 0;
  const double number = read_number(text, &length);
  if (end != nullptr)
    *end = const_cast<char*>(text) + length;
  const auto* const mantissa_end =
      std::find_if(text, text + length, [](char c) { return c == 'e' || c == 'E'; });
  const bool is_zero =
      std::none_of(text, mantissa_end, [](char c) { return c >= '1' && c <= '9'; });
  if (!std::isfinite(number) || (number == 0 && !is_zero))
    errno = ERANGE;
  return number;
}
