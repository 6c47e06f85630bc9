// Assembles, lints and times any text; errors are explained.

#include "assembler/lint/lint.h"
#include "assembler/timing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orb;
  const Source source("fuzz.macro", std::string(as_text(ByteView(data, size))));
  assembler::check(source);
  const auto assembly = assembler::assemble(source, assembler::Folding::Fold);
  for (std::size_t i = 0; i < assembly.macros.size(); ++i)
    assembler::time_macro(assembly, i);
  return 0;
}
