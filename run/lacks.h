#pragma once

#include "base/diagnostic.h"
#include "run/input.h"
#include "uploader/upload.h"

#include <span>
#include <string>
#include <vector>

namespace orb::run {

/// Something that a ball's firmware does not know.
struct Lack {
  const Source* source = nullptr; ///< of the input; null where that holds bytes
  std::string name;               ///< of the file or the macro
  Diagnostic finding;
};

/// What programs and macros use that came later than the orbBasic and the macro executive of a
/// ball, in their order; but for what a source allows by a comment. The inputs must outlive it.
std::vector<Lack> lacks_of(std::span<const Input> inputs, const uploader::Capabilities& ball);

/// Why nothing of it is sent to a ball that has greeted, with the first that it lacks and its
/// firmware: a sentence.
std::string in_words(std::span<const Lack> lacks, const uploader::Greeting& greeting);

} // namespace orb::run
