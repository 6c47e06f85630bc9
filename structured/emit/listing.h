#pragma once

#include "compiler/text/image.h"
#include "structured/emit/compiled.h"

#include <string>

namespace orb::structured {

/// Each line of the source with the lines of the image that it becomes and their bytes, in the
/// image's order; then the bytes of the main program and of each sub, wherever they stand.
std::string listing(const Compiled& compiled, const compiler::Image& image);

} // namespace orb::structured
