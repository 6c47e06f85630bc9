#include "compiler/load.h"

#include "compiler/generate.h"
#include "compiler/text/parse.h"

namespace orb::compiler {

bytecode::Chunk load(std::string_view text) {
  return generate(parse(text));
}

} // namespace orb::compiler
