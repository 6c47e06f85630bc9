// Parses decimals with JavaScript, which reads them as C does and is already loaded. The C
// library's parser adds 5 KB to the download, mostly for 128-bit numbers that nobody needs.

#include <emscripten.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

// The value of the decimal number at `text`; writes its length to `length`, 0 if there is none.
// What follows is JavaScript. clang-format off
EM_JS(double, read_number, (const char* text, int* length), {
  let end = text;
  while (HEAPU8[end])
    ++end;
  const digits = new RegExp('^([-+]?([0-9]+[.]?[0-9]*|[.][0-9]+)(e[-+]?[0-9]+)?)?', 'i')
                     .exec(new TextDecoder().decode(HEAPU8.subarray(text, end)))[0];
  HEAP32[length >> 2] = digits.length;
  return Number(digits);
})
// clang-format on

/// Replaces C's strtod (the linker's --wrap): parses the number at `text` and sets `end`; ERANGE if
/// it is too large or too small.
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
