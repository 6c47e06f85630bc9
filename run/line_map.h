#pragma once

#include "compiler/image.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace orb::run {

/// Where the robot's lines come from, so that its errors can point into a source file.
struct LineMap {
  std::string file;
  std::map<std::uint32_t, std::uint32_t> source_line; ///< by the robot's line number
};

LineMap line_map(const std::string& file, const compiler::Image& image);

/// The map that `orb build --map` writes (schema orb.map/1).
std::string print_line_map(const std::string& file, const compiler::Image& image);

/// Reads such a map; nothing where `text` is none.
std::optional<LineMap> parse_line_map(std::string_view text);

} // namespace orb::run
