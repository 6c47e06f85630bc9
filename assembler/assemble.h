#pragma once

#include "base/diagnostic.h"
#include "base/source.h"
#include "protocol/macro.h"
#include "spec/limits.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace orb::assembler {

/// The largest source that is looked at, in bytes.
inline constexpr auto largest_source =
    static_cast<std::size_t>(spec::value_of(spec::Limit::SourceBytes));

/// A command in its place.
struct PlacedCommand {
  enum class Origin : std::uint8_t {
    Written,  ///< by its mnemonic
    Raw,      ///< by `.raw`; its values may lie outside their ranges
    Broken,   ///< written, but with an error: its values mean nothing
    Supplied, ///< the End that the assembler adds
  };
  const spec::MacroCommandInfo* info = nullptr; ///< null: raw bytes that are not whole commands
  Origin origin = Origin::Written;
  Span span;                ///< the statement
  Span operand;             ///< its first operand; empty where there is none
  std::uint32_t offset = 0; ///< in the body
  std::uint32_t size = 0;
  std::array<std::int32_t, spec::macro_max_operands> value{};
};

/// One macro of a source file.
struct AssembledMacro {
  std::string name;               ///< empty where the file has no `.macro` line
  Span span;                      ///< the name, or the file's first byte
  std::optional<std::uint8_t> id; ///< as the source gives it
  std::optional<std::uint8_t>
      flags; ///< as the source gives them, with ExtFlags where `ext=` stands
  std::optional<std::uint8_t> extended_flags;
  Span flags_span;
  Bytes body;
  std::vector<PlacedCommand> commands;
  bool has_end = false;

  /// The framed macro; id 255 and the default flags where the source gives none.
  protocol::MacroImage image() const;
  /// Bytes of the framed macro.
  std::size_t framed_size() const;
};

/// The macros of a file, whole when no diagnostic is an error.
struct Assembly {
  std::vector<AssembledMacro> macros;
  std::vector<Diagnostic> diagnostics;

  bool has_errors() const;
};

/// Whether a `delay` becomes the post command delay of the command before it where that is exact:
/// the same times, fewer bytes. Commands after it get lower numbers in markers.
enum class Folding : std::uint8_t { Keep, Fold };

/// Assembles a source file: all its findings in one run, at most one syntax error a line. Any bytes
/// will do. Ranges, names and units are checked; what a macro does is the linter's matter.
Assembly assemble(const Source& source, Folding folding = Folding::Keep);

} // namespace orb::assembler
