// Disassembles any bytes. The source must assemble to the same bytes, or there is an error.

#include "assembler/assemble.h"
#include "assembler/disassemble.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orb;
  const ByteView bytes(data, size);
  for (const auto reading : {assembler::Reading::Headerless, assembler::Reading::Framed}) {
    const auto text = assembler::disassemble(bytes, reading);
    if (!text || text->size() > assembler::largest_source)
      continue;
    const auto assembly = assembler::assemble(Source("fuzz.macro", *text));
    if (assembly.has_errors())
      std::abort();
    const auto& macro = assembly.macros.at(0);
    const auto back =
        reading == assembler::Reading::Framed ? protocol::encode(macro.image()) : macro.body;
    if (!std::equal(back.begin(), back.end(), bytes.begin(), bytes.end()))
      std::abort();
  }
  return 0;
}
