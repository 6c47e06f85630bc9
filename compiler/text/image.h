#pragma once

#include "compiler/text/program.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace orb::compiler {

enum class Packing : std::uint8_t {
  Plain,  ///< the source's wording, without comments, blank lines and `let`
  Packed, ///< as short as possible with the same behaviour and line numbers
};

/// The origin of a line of an image.
struct ImageLine {
  std::uint32_t source_line = 0; ///< from 1
  std::uint32_t number = none;   ///< the robot's line number; `none` for a line without
  std::uint32_t offset = 0;      ///< bytes into the image
  std::uint32_t size = 0;        ///< with its LF
};

/// The bytes for the robot.
struct Image {
  std::string bytes; ///< lines ending in LF, then NUL
  std::vector<ImageLine> lines;
};

/// Builds the bytes to upload. Lines without a statement are left out. A line that does not
/// parse stays as it is, so that the robot reports the same error.
Image build_image(const Program& program, Packing packing);

/// The size of the plain image, including the final NUL.
std::size_t image_size(const Program& program);

/// The bytes of line `line` (an index) in the plain image.
std::size_t image_size(const Program& program, std::uint32_t line);

} // namespace orb::compiler
