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

/// The largest source that is accepted, in bytes.
inline constexpr auto largest_source =
    static_cast<std::size_t>(spec::value_of(spec::Limit::SourceBytes));

/// A command and its place in the source and in the bytes.
struct PlacedCommand {
  enum class Origin : std::uint8_t {
    Written,  ///< by its mnemonic
    Raw,      ///< by `.raw`; its values may be out of range
    Broken,   ///< written with an error; its values are meaningless
    Supplied, ///< the End added by the assembler
  };
  const spec::MacroCommandInfo* info = nullptr; ///< null: raw bytes that do not form whole commands
  Origin origin = Origin::Written;
  Span span;                ///< the statement
  Span operand;             ///< its first operand; empty without one
  std::uint32_t offset = 0; ///< in the body
  std::uint32_t size = 0;
  std::array<std::int32_t, spec::macro_max_operands> value{};
};

/// One macro of a source file.
struct AssembledMacro {
  std::string name;               ///< empty without a `.macro` line
  Span span;                      ///< the name, or the file's first byte
  std::optional<std::uint8_t> id; ///< as in the source
  std::optional<std::uint8_t>
      flags; ///< as in the source; includes ExtFlags if the source gives `ext=`
  std::optional<std::uint8_t> extended_flags;
  Span flags_span;
  Bytes body;
  std::vector<PlacedCommand> commands;
  bool has_end = false;

  /// The framed macro, with id 255 and the default flags unless the source gives others.
  protocol::MacroImage image() const;
  /// Size of the framed macro in bytes.
  std::size_t framed_size() const;
};

/// The macros of a file; complete only if no diagnostic is an error.
struct Assembly {
  std::vector<AssembledMacro> macros;
  std::vector<Diagnostic> diagnostics;

  bool has_errors() const;
};

/// Fold turns a `delay` into the post command delay of the command before it where that is exact:
/// the same times in fewer bytes. Later commands get lower numbers in markers.
enum class Folding : std::uint8_t { Keep, Fold };

/// Assembles a source file and reports all findings in one run, at most one syntax error per line.
/// Accepts any bytes. Checks ranges, names and units; the linter checks the behaviour of macros.
Assembly assemble(const Source& source, Folding folding = Folding::Keep);

} // namespace orb::assembler
