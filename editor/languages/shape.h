#pragma once

// The second half of LanguageService: colours, folds, selection ranges, links, calls.

#include "editor/language.h"
#include "editor/word_at.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {

/// The kind of a piece of text. `color_names` has the protocol's names in this order.
enum class Color : std::uint8_t {
  Comment,
  Keyword,
  String,
  Pattern,
  Number,
  Operator,
  Function,
  Variable,
  Parameter,
  Value,
  Label,
};

inline constexpr auto color_names =
    std::to_array<std::string_view>({"comment", "keyword", "string", "regexp", "number", "operator",
                                     "function", "variable", "parameter", "enumMember", "label"});

/// Modifiers of a colour, as bits; `trait_names` has their names.
enum Trait : std::uint8_t { Plain = 0, Declared = 1, Fixed = 2, Changed = 4, Robots = 8 };

inline constexpr auto trait_names =
    std::to_array<std::string_view>({"declaration", "readonly", "modification", "defaultLibrary"});

struct Colored {
  Span span;
  Color color = Color::Comment;
  std::uint8_t traits = Plain;
};

/// Lines (from 1) that can be folded into the first one.
struct Fold {
  std::uint32_t first = 1;
  std::uint32_t last = 1;
  bool is_comment = false;
};

/// The parameters of a statement, a command or a routine.
struct Signature {
  struct Parameter {
    Span in_label;
    std::string text; ///< its range; may be empty
  };
  std::string label;
  std::string markdown;
  std::vector<Parameter> parameters;
  std::size_t active = 0; ///< index of the parameter being written; past the end for none
};

/// A file name in the text.
struct Link {
  Span span;
  std::string path;
};

/// An action at a place. `deed` decides title and command.
struct Lens {
  enum class Deed : std::uint8_t { Run, Debug, RunTest, DebugTest };
  Span span;
  Deed deed = Deed::Run;
  std::string name; ///< of the test; empty for the whole file
};

/// A part of a program that can be called, or the program itself.
struct Callable {
  std::string name;
  std::string detail;
  std::shared_ptr<const Source> source; ///< null: the text itself
  Span span;
  Span selection;
};

struct Call {
  std::size_t caller = 0; ///< index into Calls::callables
  std::size_t callee = 0;
  Span site; ///< in the caller's text
};

struct Calls {
  std::vector<Callable> callables;
  std::vector<Call> calls;
};

/// Every function is pure and accepts any text, however broken. Null means not supported.
struct LanguageShape {
  /// Returns colours in order of the text, without overlaps, none across lines.
  std::vector<Colored> (*colors)(const Source& source, const LanguageOptions& options);
  std::vector<Fold> (*folds)(const Source& source);
  /// Returns units that may contain `offset`, in any order, without the line and the whole text.
  /// nested() selects.
  std::vector<Span> (*around)(const Source& source, std::uint32_t offset);
  std::optional<Signature> (*signature)(const Source& source, std::uint32_t offset,
                                        const LanguageOptions& options);
  std::vector<Link> (*links)(const Source& source) = nullptr;
  std::vector<Lens> (*lenses)(const Source& source) = nullptr;
  Calls (*calls)(const Source& source, const LanguageOptions& options) = nullptr;
};

extern const LanguageShape basic_shape;
extern const LanguageShape structured_shape;
extern const LanguageShape macro_shape;
extern const LanguageShape test_shape;
extern const LanguageShape stimulus_shape;

/// Collects colours: known names first, then the words around them.
class Palette {
public:
  void add(Span span, Color color, unsigned traits = Plain) {
    if (span.size() > 0)
      found_.push_back({span, color, static_cast<std::uint8_t>(traits)});
  }
  /// Returns them in order; of two that overlap, the one added first.
  std::vector<Colored> take();

private:
  std::vector<Colored> found_;
};

/// Adds a token coloured by its kind; words have no colour of their own.
void color_token(Palette& palette, const Token& token);

/// Adds a statement or variable of the robot.
void color_statement(Palette& palette, Span span, const spec::StatementInfo& row);
void color_system(Palette& palette, Span span, const spec::VariableInfo& row);

/// Folds consecutive lines of comments.
std::vector<Fold> comment_folds(const Source& source, char comment);

/// Folds line `first` to the last non-blank line up to `last`, if that hides something.
void add_fold(std::vector<Fold>& folds, const Source& source, std::uint32_t first,
              std::uint32_t last);

/// Returns those of `spans`, plus the line and the whole text, that contain `offset`, innermost
/// first.
std::vector<Span> nested(const Source& source, std::uint32_t offset, std::vector<Span> spans);

/// Writes `word a, b, c` piece by piece and records the places of the parameters.
class SignatureText {
public:
  explicit SignatureText(std::string_view head) { made_.label = head; }
  void add(std::string_view between, std::string_view name, std::string text);
  void close(std::string_view end) { made_.label += end; }
  Signature take(std::size_t active, std::string markdown);

private:
  Signature made_;
};

/// The parameters of a statement of the robot, with `commas` commas before the cursor.
std::optional<Signature> statement_signature(const spec::StatementInfo& row, std::size_t commas,
                                             std::string_view language);

/// Lenses that run and debug a program, at its first line.
std::vector<Lens> run_lenses(const Source& source);

/// A clearer form of a number: milliseconds from a second on as seconds, a heading as an arrow on a
/// map with 0 at the top. `at` is the end of the number.
std::optional<Hint> number_hint(std::string_view parameter, std::string_view unit,
                                std::int64_t value, std::uint32_t at);

} // namespace orb::editor
