#include "run/listing.h"

#include "compiler/load.h"
#include "vm/machine/native/native.h"

namespace orb::run {

std::string listing(const compiler::Image& image, Listed listed) {
  const auto chunk = compiler::load(image.bytes);
  const auto native =
      listed == Listed::MachineCode ? vm::native_listing(chunk) : vm::NativeListing{};
  std::string out = native.entry;
  for (std::size_t i = 0; i < chunk.lines.size(); ++i) { // each line of an image has a statement
    out += image.bytes.substr(image.lines[i].offset, image.lines[i].size);
    out += bytecode::listing(chunk, i);
    if (i < native.lines.size())
      out += native.lines[i];
  }
  return out + native.exits;
}

} // namespace orb::run
