#pragma once

#include "base/diagnostic.h"
#include "run/input.h"
#include "uploader/upload.h"

#include <span>
#include <string>
#include <vector>

namespace orb::run {

/// A feature that a ball's firmware lacks.
struct Lack {
  const Source* source = nullptr; ///< of the input; null if it holds bytes
  std::string name;               ///< of the file or macro
  Diagnostic finding;
};

/// Returns uses of features newer than the ball's orbBasic or macro executive, in order, except
/// those that the source allows by a comment. The inputs must outlive the result.
std::vector<Lack> lacks_of(std::span<const Input> inputs, const uploader::Capabilities& ball);

/// Explains in a sentence why nothing is sent, with the first missing feature and the ball's
/// firmware.
std::string in_words(std::span<const Lack> lacks, const uploader::Greeting& greeting);

} // namespace orb::run
