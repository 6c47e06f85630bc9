// Checks a program and prints its findings, as `orb check` does.
#include <orb/base/render.h>
#include <orb/compiler/check.h>

#include <cstdio>

int main() {
  const orb::Source source("blink.bas", "10 RGB 255,0\n20 goto 30\n");
  const auto checked = orb::compiler::check(source.text(), {});
  for (const auto& finding : checked.diagnostics)
    std::fputs(render_text(source, finding, {}).c_str(), stdout);
  return checked.diagnostics.size() == 2 ? 0 : 1;
}
