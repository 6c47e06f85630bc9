// Takes any bytes as orbBasic: checking, fixing, formatting, packing and loading must survive them.

#include "compiler/check.h"
#include "compiler/load.h"
#include "compiler/text/image.h"
#include "compiler/text/parse_basic.h"
#include "compiler/text/print.h"

#include <cstdint>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orb::compiler;
  // Without a final NUL, as users of the library may pass it.
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static_cast<void>(check(text, {}));
  const auto formatted = format(parse(text));
  if (format(parse(formatted)) != formatted)
    std::abort();
  const auto packed = build_image(parse(text), Packing::Packed).bytes;
  if (build_image(parse(packed), Packing::Packed).bytes != packed)
    std::abort();
  static_cast<void>(fix(std::string(text), {}));
  static_cast<void>(load(text));
  return 0;
}
