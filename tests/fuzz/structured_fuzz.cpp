// Compiles any text as a structured program in bounded time. Every fix gives a text again, and the
// plain compiler accepts the output.

#include "base/fixes.h"
#include "compiler/check.h"
#include "structured/compile.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orb;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  structured::NoFiles files;
  const auto compiled = structured::compile("fuzz.orb", "fuzz.orb", text, {}, files);
  const auto findings = structured::findings_by_file(compiled.program);
  for (const auto& finding : findings.front())
    if (finding.span.begin > finding.span.end || finding.span.end > size)
      std::abort();
  apply_fixes(text, findings.front());
  if (compiled.has_errors() || compiled.robot.lines.empty())
    return 0;
  for (const auto& finding : compiler::check(compiled.robot.text, {}).diagnostics)
    if (finding.severity == Severity::Error && finding.rule->id != "program-too-large")
      std::abort();
  return 0;
}
