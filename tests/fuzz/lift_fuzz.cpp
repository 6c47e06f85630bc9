// Lifts any text as a numbered program, or refuses it. A lifted program must compile and keep its
// layout when formatted.

#include "compiler/check.h"
#include "structured/compile.h"
#include "structured/layout/format.h"
#include "structured/lift/lift.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orb;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto lifted = structured::lift(compiler::check(text, {}));
  for (const auto& found : lifted.findings)
    if (found.span.begin > found.span.end || found.span.end > size)
      std::abort();
  if (lifted.text.empty())
    return lifted.findings.empty() ? (std::abort(), 0) : 0;
  structured::NoFiles files;
  if (structured::compile("", "", lifted.text, {}, files).has_errors() ||
      structured::format(lifted.text) != lifted.text)
    std::abort();
  return 0;
}
