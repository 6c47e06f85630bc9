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

/// A call that the compiler replaced by the body of the sub. Lines and columns count from 1.
struct WrittenCall {
  std::uint32_t id = 0; ///< shared by all lines written for this call
  std::uint32_t file = 0;
  std::uint32_t line = 1;
  std::uint32_t column = 1;
  std::string sub = {}; ///< the calling sub; empty for the main part

  friend bool operator==(const WrittenCall&, const WrittenCall&) = default;
};

/// Source of a robot line. Lines and columns count from 1.
struct LinePlace {
  std::uint32_t file = 0; ///< index into LineMap::files
  std::uint32_t line = 1;
  std::uint32_t column = 1;
  std::string sub = {}; ///< sub or function of a structured program; empty for its main part
  /// The inlined calls that lead here, outermost first.
  std::vector<WrittenCall> calls = {};
};

/// An inlined sub, recorded even if nothing remains of it.
struct WrittenSub {
  std::string called;
  LinePlace place; ///< of the call
};

/// Detail known about source places.
enum class Known : std::uint8_t { Line, FileAndColumn };

/// Maps the robot's lines to source places, so that errors can point into the sources.
struct LineMap {
  std::vector<std::string> files;
  std::map<std::uint32_t, LinePlace> places; ///< by robot line number
  Known known = Known::Line;
  std::vector<WrittenSub> calls = {};

  /// Returns for example `patrol.orb:12:3`; empty for an unknown line.
  std::string words(std::uint32_t robot_line) const;
};

LineMap line_map(const std::string& file, const compiler::Image& image);
LineMap line_map(const structured::Compiled& compiled);

/// Writes the map for `orb build --map` (schema orb.map/1). Lines of a structured program also have
/// file, column, sub and the inlined calls.
std::string print_line_map(const LineMap& map, const compiler::Image& image);

/// Parses such a map; nullopt if `text` is none.
std::optional<LineMap> parse_line_map(std::string_view text);

} // namespace orb::run
