#pragma once

#include "compiler/text/program.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace orb::compiler {

enum class Packing : std::uint8_t {
  Plain,  ///< the source's own words: comments and blank lines gone, `let` left out
  Packed, ///< as short as it gets with the same behaviour and the same line numbers
};

/// Where one line of an image comes from.
struct ImageLine {
  std::uint32_t source_line = 0; ///< from 1
  std::uint32_t number = none;   ///< the robot's line number; `none` for a line without
  std::uint32_t offset = 0;      ///< bytes into the image
  std::uint32_t size = 0;        ///< with its LF
};

/// What goes to the robot.
struct Image {
  std::string bytes; ///< lines ending in LF, then NUL
  std::vector<ImageLine> lines;
};

/// Makes the bytes to upload. Lines without a statement are left out; a line that does not
/// parse is kept as it is, so that the robot finds the same mistake.
Image build_image(const Program& program, Packing packing);

/// The size of the plain image, final NUL included.
std::size_t image_size(const Program& program);

/// What line `line` (an index) takes of it.
std::size_t image_size(const Program& program, std::uint32_t line);

} // namespace orb::compiler
