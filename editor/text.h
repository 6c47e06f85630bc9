#pragma once

#include "base/source.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace orb::editor {

/// What `character` counts in a position of the protocol: bytes, UTF-16 units or code points.
enum class PositionEncoding : std::uint8_t { Utf8, Utf16, Utf32 };

/// A place as the protocol gives it: both count from 0.
struct TextPosition {
  std::uint32_t line = 0;
  std::uint32_t character = 0;

  friend constexpr bool operator==(TextPosition, TextPosition) = default;
};

/// The byte at `position`. A place after the end of a line is its end, one after the last line
/// the end of the text; one inside a code point is its beginning.
std::uint32_t offset_of(const Source& source, TextPosition position, PositionEncoding encoding);

/// Finds places: one after the other in a line without going back to its beginning.
class Ruler {
public:
  Ruler(const Source& source, PositionEncoding encoding) : source_(&source), encoding_(encoding) {}

  /// The place of byte `offset`; after the end of the text it is the end.
  TextPosition operator()(std::uint32_t offset);

private:
  const Source* source_;
  PositionEncoding encoding_;
  std::size_t at_ = 0; ///< the byte of its line that `last_` is
  TextPosition last_;
};

/// The path in a `file:` URI; anything else stays as it is.
std::string path_of_uri(std::string_view uri);

/// The `file:` URI of a path; of what does not begin with `/` the same text.
std::string uri_of_path(std::string_view path);

} // namespace orb::editor
