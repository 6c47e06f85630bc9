#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace orb {

/// A half-open range of bytes in one Source.
struct Span {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  constexpr std::uint32_t size() const { return end - begin; }
  friend constexpr bool operator==(Span, Span) = default;
};

/// A place in a text. Line and column count from 1; the column counts bytes.
struct Position {
  std::uint32_t line = 1;
  std::uint32_t column = 1;

  friend constexpr bool operator==(Position, Position) = default;
};

/// The last part of a path; all of it if there is no `/`.
std::string_view file_name(std::string_view path);
/// The file name without folders and extension.
std::string_view stem(std::string_view path);

/// A named text with its line starts. LF, CR and CRLF all end a line (decision A-3).
class Source {
public:
  Source(std::string name, std::string text);

  const std::string& name() const { return name_; }
  std::string_view text() const { return text_; }
  std::string_view text(Span span) const;

  std::uint32_t line_count() const { return static_cast<std::uint32_t>(starts_.size()); }
  /// The place of byte `offset`. One past the last byte is valid; larger offsets are clamped.
  Position position(std::uint32_t offset) const;
  /// The text of line `line` (from 1) without its line ending; empty beyond the last line.
  std::string_view line(std::uint32_t line) const;
  /// The byte where line `line` (from 1) begins; the size of the text beyond the last line.
  std::uint32_t line_start(std::uint32_t line) const;
  /// The span of line `line`, without its line ending.
  Span line_span(std::uint32_t line) const;

private:
  std::string name_;
  std::string text_;
  std::vector<std::uint32_t> starts_;
};

} // namespace orb
