#pragma once

#include "base/diagnostic.h"
#include "base/exit_code.h"
#include "base/source.h"
#include "compiler/lint/lint.h"
#include "compiler/text/image.h"
#include "protocol/macro.h"
#include "run/line_map.h"
#include "structured/compile.h"
#include "structured/text/files.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

// Reads programs and macros, for all commands.

namespace orb::run {

/// The language of a source.
enum class Language : std::uint8_t { Basic, Structured, Macro };

/// The content of a file.
enum class Content : std::uint8_t {
  Basic,       ///< orbBasic: source, or a built image with its final NUL
  Structured,  ///< a program in structured orbBasic
  MacroSource, ///< macro source
  MacroBody,   ///< the commands of one macro: `.sphero`
  MacroImage,  ///< a framed macro: `.bin`
};

/// Determines the content from `language` (`basic`, `structured`, `macro` or empty), otherwise from
/// the extension of `name`.
std::optional<Content> content_of(std::string_view name, std::string_view language);

/// Determines the language in the same way; nullopt if the file holds bytes or is unknown.
std::optional<Language> language_of(std::string_view name, std::string_view language);

/// Guesses the language of a program in plain text, as a value for `language`: `basic` if it begins
/// with a number, `macro` if with a dot, otherwise `structured`.
std::string_view language_of_text(std::string_view text);

/// A source and its language: programs and macro sources, not bytes. Courses and tests have no
/// language.
struct SourceFile {
  std::string path;
  std::optional<Language> language;
  Source source;
  bool is_bytes = false; ///< the file holds a macro's bytes, from which the source is derived
};

/// Returns the macro source for a `.sphero` or `.bin` file. Fails with BadInput if the bytes are
/// not a macro.
tl::expected<std::string, Failure> macro_source(std::string_view name, std::string_view bytes);

/// Returns true if the extension of `name` denotes macro bytes.
bool holds_macro_bytes(std::string_view name);

/// Failure for writing text to a file of bytes: code 2, with the command that converts it to
/// source.
Failure not_text(std::string_view name);

/// Failure for unknown content: code 2, with what to add.
Failure unknown_content(std::string_view name);

/// A program ready to be sent.
struct Program {
  compiler::Program parsed; ///< refers to the source of its input, or to the compiled text
  compiler::Image image;
  LineMap lines;
  std::unique_ptr<structured::Compiled> compiled; ///< null for hand-written robot lines

  /// The first line number at which the robot can start; nullopt if there is none.
  std::optional<std::uint16_t> first_line() const;
  /// Returns `line 20`; for a structured program the place in its source, for example
  /// `patrol.orb:12:3`.
  std::string where(std::uint32_t robot_line) const;
};

/// A macro ready to be sent.
struct Macro {
  std::string name;
  protocol::MacroImage image;
  bool has_id = false; ///< the file specifies the id
  /// Source line of command k + 1; 0 if it is not written out; empty for bytes.
  std::vector<std::uint32_t> command_lines;
};

/// Cached result of findings().
struct Checked {
  std::once_flag once;
  std::vector<FileFindings> files; ///< filled on first use, unless reading produces all findings
};

/// One file: a program, or one or more macros.
struct Input {
  std::unique_ptr<Source> source;
  compiler::Target target; ///< what findings() checks a program against
  std::optional<Program> program;
  std::vector<Macro> macros;
  /// The files included by a structured program, in the order of Program::lines.files, without the
  /// source itself.
  std::vector<std::unique_ptr<Source>> included;
  std::vector<Input> used; ///< macro files used by the program
  /// Findings of reading, for the source and then each included file: what prevents a build. If
  /// they contain an error, the other members are for inspection only.
  std::vector<FileFindings> errors;
  std::unique_ptr<Checked> checked = std::make_unique<Checked>();

  bool has_errors() const;
};

/// Reads the file `name` without checking it. Bytes that are not a macro are a failure; mistakes in
/// a source become findings. An unknown extension is accepted if the text is a built image. Files
/// named by a structured program are read through `files`, relative to `name`; its variables `kept`
/// hold their values to the end (structured/compile.h). If the steppable shape does not fit, the
/// shortest one is used.
tl::expected<Input, Failure> read_input(std::string name, std::string text,
                                        std::string_view language, const compiler::Target& target,
                                        structured::Files& files,
                                        const std::vector<std::string>& kept = {},
                                        structured::Shape shape = structured::Shape::Shortest);

/// Returns all findings for an input: for the source, then for each included file. Checks on first
/// use; thread-safe.
const std::vector<FileFindings>& findings(const Input& input);

/// Returns the first input with a program; null if there is none.
const Input* first_with_program(std::span<const Input> inputs);

/// Refuses a start line for structured programs, because their lines have no numbers.
tl::expected<void, Failure> check_start_line(std::span<const Input> inputs,
                                             std::optional<std::uint16_t> line);

/// Adds an input, preceded by the macro files it uses. Skips files already present.
void add_input(std::vector<Input>& inputs, Input input);

} // namespace orb::run
