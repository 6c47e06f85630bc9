#pragma once

#include "compiler/text/image.h"
#include "structured/emit/compiled.h"

#include <string>

namespace orb::structured {

/// Prints each source line with the image lines compiled from it and their bytes, in the order of
/// the image; then the total bytes of the main program and of each sub.
std::string listing(const Compiled& compiled, const compiler::Image& image);

} // namespace orb::structured
