#pragma once

#include "base/source.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace orb::editor {

/// The unit of `character` in the protocol's positions: bytes, UTF-16 units or code points.
enum class PositionEncoding : std::uint8_t { Utf8, Utf16, Utf32 };

/// A position of the protocol; both numbers count from 0.
struct TextPosition {
  std::uint32_t line = 0;
  std::uint32_t character = 0;

  friend constexpr bool operator==(TextPosition, TextPosition) = default;
};

/// The byte at `position`. Past the end of a line it is the line's end, past the last line the end
/// of the text, inside a code point its beginning.
std::uint32_t offset_of(const Source& source, TextPosition position, PositionEncoding encoding);

/// Converts byte offsets to positions. Ascending offsets within a line do not rescan it.
class Ruler {
public:
  Ruler(const Source& source, PositionEncoding encoding) : source_(&source), encoding_(encoding) {}

  /// The position of byte `offset`; past the end of the text it is the end.
  TextPosition operator()(std::uint32_t offset);

private:
  const Source* source_;
  PositionEncoding encoding_;
  std::size_t at_ = 0; ///< byte within the line that matches `last_`
  TextPosition last_;
};

/// The path in a `file:` URI; returns other texts unchanged.
std::string path_of_uri(std::string_view uri);

/// The `file:` URI of a path; returns texts without a leading `/` unchanged.
std::string uri_of_path(std::string_view path);

} // namespace orb::editor
