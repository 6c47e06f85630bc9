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

// What users hand to orb: one reader for every command that takes programs and macros.

namespace orb::run {

/// What a source is written in.
enum class Language : std::uint8_t { Basic, Structured, Macro };

/// What a file holds.
enum class Content : std::uint8_t {
  Basic,       ///< an orbBasic program: source, or a built image with its final NUL
  Structured,  ///< a program in structured orbBasic
  MacroSource, ///< macro source
  MacroBody,   ///< the commands of one macro: `.sphero`
  MacroImage,  ///< a framed macro: `.bin`
};

/// What the ending of `name` says, or `language` (`basic`, `structured`, `macro` or empty), which
/// is stronger.
std::optional<Content> content_of(std::string_view name, std::string_view language);

/// The language of a source, by the same rule; nothing where the file holds bytes or cannot be
/// told.
std::optional<Language> language_of(std::string_view name, std::string_view language);

/// What a program in plain text is written in, as `language` names it: where it begins with a
/// number `basic`, with a dot `macro`, else `structured`.
std::string_view language_of_text(std::string_view text);

/// A source in its language: programs and macro source, not bytes. Courses and tests have none.
struct SourceFile {
  std::string path;
  std::optional<Language> language;
  Source source;
  bool is_bytes = false; ///< the file holds a macro's bytes, and the source is made from them
};

/// The macro source of a file that holds bytes, a `.sphero` or a `.bin`; BadInput where they are no
/// macro.
tl::expected<std::string, Failure> macro_source(std::string_view name, std::string_view bytes);

/// Whether the ending of `name` says that it holds the bytes of a macro.
bool holds_macro_bytes(std::string_view name);

/// That a file of bytes is not written as text: code 2, and the command that makes a source of it.
Failure not_text(std::string_view name);

/// That the form of `name` cannot be told: code 2, and what to add.
Failure unknown_content(std::string_view name);

/// A program as it goes to a ball.
struct Program {
  compiler::Program parsed; ///< refers to the source of its input, or to the compiled text
  compiler::Image image;
  LineMap lines;
  std::unique_ptr<structured::Compiled> compiled; ///< null where the lines were written by hand

  /// The number of the first line that the robot can start at; nothing where there is none.
  std::optional<std::uint16_t> first_line() const;
  /// `line 20`; of a structured program the place in its source, as in `patrol.orb:12:3`.
  std::string where(std::uint32_t robot_line) const;
};

/// A macro as it goes to a ball.
struct Macro {
  std::string name;
  protocol::MacroImage image;
  bool has_id = false;                      ///< the file gives the id
  std::vector<std::uint32_t> command_lines; ///< of command number k + 1, 0 for one that is not
                                            ///< written; empty for bytes
};

/// What findings() has found, for whoever asks next.
struct Checked {
  std::once_flag once;
  std::vector<FileFindings> files; ///< empty before somebody asks, if reading does not tell all
};

/// One file: a program, or one or more macros.
struct Input {
  std::unique_ptr<Source> source;
  compiler::Target target; ///< what findings() checks a program for
  std::optional<Program> program;
  std::vector<Macro> macros;
  /// In the order of Program::lines.files, after the source: what a structured program includes.
  std::vector<std::unique_ptr<Source>> included;
  std::vector<Input> used; ///< the macro files that go along with the program
  /// What reading it told, about the source and then each included file: why it cannot be built.
  /// With an error among them, what else is there is good only for a look.
  std::vector<FileFindings> errors;
  std::unique_ptr<Checked> checked = std::make_unique<Checked>();

  bool has_errors() const;
};

/// Reads the content of the file `name`, without a check. Bytes that are not a macro are a failure;
/// mistakes of a source are findings. A name that says nothing will do where the text is a built
/// image. What a structured program names is read through `files`, its paths counting from `name`;
/// its variables `kept` hold their values to the end (structured/compile.h). One that does not fit
/// while it is steppable becomes the shortest.
tl::expected<Input, Failure> read_input(std::string name, std::string text,
                                        std::string_view language, const compiler::Target& target,
                                        structured::Files& files,
                                        const std::vector<std::string>& kept = {},
                                        structured::Shape shape = structured::Shape::Shortest);

/// All that is to be said about an input: of the source, then of each included file. Whoever asks
/// first, in whichever thread, has it checked.
const std::vector<FileFindings>& findings(const Input& input);

/// The first input that holds a program; null where none does.
const Input* first_with_program(std::span<const Input> inputs);

/// Refuses a line to start at where the program is structured: its lines have no numbers.
tl::expected<void, Failure> check_start_line(std::span<const Input> inputs,
                                             std::optional<std::uint16_t> line);

/// Adds an input and before it the macro files that it uses; a file is taken once.
void add_input(std::vector<Input>& inputs, Input input);

} // namespace orb::run
