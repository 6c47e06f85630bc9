#pragma once

#include "compiler/text/image.h"
#include "structured/compile.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::run {

/// A call in whose place the compiler has written the sub itself. Lines and columns count from 1.
struct WrittenCall {
  std::uint32_t id = 0; ///< the same for all lines that were written for this call
  std::uint32_t file = 0;
  std::uint32_t line = 1;
  std::uint32_t column = 1;
  std::string sub = {}; ///< that calls; empty for the main part

  friend bool operator==(const WrittenCall&, const WrittenCall&) = default;
};

/// Where a line of the robot comes from. Lines and columns count from 1.
struct LinePlace {
  std::uint32_t file = 0; ///< index into LineMap::files
  std::uint32_t line = 1;
  std::uint32_t column = 1;
  std::string sub = {}; ///< the sub or function of a structured program; empty for its main part
  /// The calls that led here without a `gosub` of the robot, the outermost first.
  std::vector<WrittenCall> calls = {};
};

/// A sub that was written in place of a call, whatever is left of it.
struct WrittenSub {
  std::string called;
  LinePlace place; ///< of the call
};

/// What is known about a line's place besides its line.
enum class Known : std::uint8_t { Line, FileAndColumn };

/// Where the robot's lines come from, so that its errors can point into the sources.
struct LineMap {
  std::vector<std::string> files;
  std::map<std::uint32_t, LinePlace> places; ///< by the robot's line number
  Known known = Known::Line;
  std::vector<WrittenSub> calls = {};

  /// `patrol.orb:12:3`; empty for a line that is not known.
  std::string words(std::uint32_t robot_line) const;
};

LineMap line_map(const std::string& file, const compiler::Image& image);
LineMap line_map(const structured::Compiled& compiled);

/// The map that `orb build --map` writes (schema orb.map/1). Of a structured program each line also
/// says its file, column and sub, and the calls in whose place it was written.
std::string print_line_map(const LineMap& map, const compiler::Image& image);

/// Reads such a map; nothing where `text` is none.
std::optional<LineMap> parse_line_map(std::string_view text);

} // namespace orb::run
