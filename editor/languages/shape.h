#pragma once

// What an editor draws of a text and where it leads, without any protocol: colours, folds, what
// surrounds a place, links, calls. Like LanguageService, whose second half it is.

#include "editor/language.h"
#include "editor/words.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::editor {

/// What a piece of text is. The protocol's names are in `color_names`, in this order.
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

/// What else is true of it; bits, whose names are in `trait_names`.
enum Trait : std::uint8_t { Plain = 0, Declared = 1, Fixed = 2, Changed = 4, Robots = 8 };

inline constexpr auto trait_names =
    std::to_array<std::string_view>({"declaration", "readonly", "modification", "defaultLibrary"});

struct Colored {
  Span span;
  Color color = Color::Comment;
  std::uint8_t traits = Plain;
};

/// Lines (from 1) that can be hidden behind the first one.
struct Fold {
  std::uint32_t first = 1;
  std::uint32_t last = 1;
  bool is_comment = false;
};

/// What a statement, a command or a routine takes.
struct Signature {
  struct Parameter {
    Span in_label;
    std::string text; ///< its range; may be empty
  };
  std::string label;
  std::string markdown;
  std::vector<Parameter> parameters;
  std::size_t active = 0; ///< the parameter that is being written; past the end for none
};

/// A file that the text names.
struct Link {
  Span span;
  std::string path;
};

/// Something that a user may do with a place. The title and the command are those of `deed`.
struct Lens {
  enum class Deed : std::uint8_t { Run, Debug, RunTest, DebugTest };
  Span span;
  Deed deed = Deed::Run;
  std::string name; ///< of the test; empty for all of the file
};

/// A part of a program that can be called, and the program itself.
struct Callable {
  std::string name;
  std::string detail;
  std::shared_ptr<const Source> source; ///< null: the text that was asked about
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

/// Every function is pure and takes any text, however broken. Null: the language has none.
struct LanguageShape {
  /// In the order of the text, none over another, none over more than one line.
  std::vector<Colored> (*colors)(const Source& source, const LanguageOptions& options);
  std::vector<Fold> (*folds)(const Source& source);
  /// Units that may hold `offset`, in any order; the text and its lines excepted. nested() chooses.
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

/// Collects colours: names that are known first, then the words around them.
class Palette {
public:
  void add(Span span, Color color, unsigned traits = Plain) {
    if (span.size() > 0)
      found_.push_back({span, color, static_cast<std::uint8_t>(traits)});
  }
  /// In order; of two that overlap the one that was added first stays.
  std::vector<Colored> take();

private:
  std::vector<Colored> found_;
};

/// Adds what is told by the kind of a token alone; a word is nothing by itself.
void color_token(Palette& palette, const Token& token);

/// Adds a word that is a statement of the robot, or one of its variables.
void color_statement(Palette& palette, Span span, const spec::StatementInfo& row);
void color_system(Palette& palette, Span span, const spec::VariableInfo& row);

/// Runs of lines that hold only a comment.
std::vector<Fold> comment_folds(const Source& source, char comment);

/// From line `first` to the last line up to `last` that is not blank, where that hides something.
void add_fold(std::vector<Fold>& folds, const Source& source, std::uint32_t first,
              std::uint32_t last);

/// Those of `spans`, with the line and the whole text, that hold `offset`, each in the next one.
std::vector<Span> nested(const Source& source, std::uint32_t offset, std::vector<Span> spans);

/// Writes `word a, b, c` piece by piece, so that the places of the parameters are known.
class SignatureText {
public:
  explicit SignatureText(std::string_view head) { made_.label = head; }
  void add(std::string_view between, std::string_view name, std::string text);
  void close(std::string_view end) { made_.label += end; }
  Signature take(std::size_t active, std::string markdown);

private:
  Signature made_;
};

/// What a statement of the robot takes, while its argument after `commas` commas is written.
std::optional<Signature> statement_signature(const spec::StatementInfo& row, std::size_t commas,
                                             std::string_view language);

/// To run a program and to debug it, at its first line.
std::vector<Lens> run_lenses(const Source& source);

/// What a number says more clearly: milliseconds from a second on as seconds, a heading as an arrow
/// over a map with 0 at the top. `at` is where the number ends.
std::optional<Hint> number_hint(std::string_view parameter, std::string_view unit,
                                std::int64_t value, std::uint32_t at);

} // namespace orb::editor
