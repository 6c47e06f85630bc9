#pragma once

#include "base/message.h"
#include "base/source.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb {

enum class Severity : std::uint8_t { Info, Warning, Error };

/// `info`, `warning` or `error`, as in the text and JSON forms.
std::string_view to_string(Severity severity);

/// The kind of error in a line, for any language. repair/ uses it to choose where to search for the
/// intended line.
enum class Trouble : std::uint8_t {
  Other,
  Unreadable,         ///< not a statement of the language
  MalformedLine,      ///< a known statement with malformed parts
  UnknownName,        ///< an undefined name
  ForeignWord,        ///< a word of another language
  ReservedName,       ///< a name reserved by the language
  WrongValue,         ///< a value of the wrong kind
  ArgumentCount,      ///< too many values or too few
  MisplacedStatement, ///< an exit or similar outside its block
  UnclosedBlock,      ///< a block without its end
  BlockEnd,           ///< an end without its block
  Pattern,            ///< inside a text in another language
};

/// A lint rule. Rules live in tables beside the code that raises them; `orb explain`, SARIF and
/// docs/reference/rules.md are printed from the same rows.
struct Rule {
  std::string_view id; ///< kebab-case, unique over all tables
  Severity severity = Severity::Error;
  std::string_view summary;     ///< one sentence
  std::string_view explanation; ///< why it matters and what to do instead
  std::string_view bad;         ///< a minimal source that raises the rule
  std::string_view good;        ///< the same, corrected
  std::uint8_t robot_error = 0; ///< the error number that the robot would report; 0: none
  Trouble trouble = Trouble::Other;
};

/// The row as linked into a program. ORB_BRIEF_RULES drops the explanations, to keep the download
/// of a web page small.
constexpr Rule carried(Rule row) {
#ifdef ORB_BRIEF_RULES
  row.explanation = row.bad = row.good = {};
#endif
  return row;
}

struct Edit {
  Span span;
  std::string text;
};

/// Safe edits keep the meaning of a working program; unsafe ones need review.
enum class Safety : std::uint8_t { Safe, Unsafe };

struct Fix {
  Message title;
  std::vector<Edit> edits; ///< ascending, not overlapping
  Safety safety = Safety::Safe;
};

/// A replacement line that was tried by the repair.
struct Considered {
  enum class Effect : std::uint8_t {
    Worse,  ///< adds errors, on this line or others
    Parses, ///< leaves the number of errors unchanged
    Mends,  ///< leaves fewer errors
  };
  std::string line;
  std::string_view origin; ///< the step that proposed it
  int cost = 0;            ///< cheapest first
  Effect effect = Effect::Worse;
};

struct Note {
  Span span;
  Message message;
};

/// One finding about the user's input. Plain data: renderers print it, the policy sets its
/// severity.
struct Diagnostic {
  const Rule* rule = nullptr;
  Severity severity = Severity::Error; ///< the rule's, unless the policy changed it
  Span span;
  Message message; ///< the problem: lower case, no full stop, code in backticks
  Message help;    ///< the advice; may be empty
  std::vector<Note> notes;
  std::optional<Fix> fix;
  std::vector<Considered> considered;      ///< replacement lines tried, in order
  std::optional<std::uint32_t> basic_line; ///< the orbBasic line number, if it has one
};

/// Makes a finding of `rule` at `span`, with the rule's severity.
Diagnostic finding(const Rule& rule, Span span, Message message, Message help = {});

inline bool is_error(const Diagnostic& diagnostic) {
  return diagnostic.severity == Severity::Error;
}
bool any_error(const std::vector<Diagnostic>& findings);

/// True if no program can be built with this finding. A warning raised to an error because it is
/// certain to happen still builds: the program can be run to see how it stops.
inline bool keeps_from_building(const Diagnostic& diagnostic) {
  return is_error(diagnostic) && diagnostic.rule->severity == Severity::Error;
}

/// The findings of one file, as passed to the renderers.
struct FileFindings {
  const Source* source = nullptr;
  std::vector<Diagnostic> diagnostics;
  std::optional<std::size_t> built_size; ///< bytes of the image, if it was built
};

struct Counts {
  std::size_t errors = 0;
  std::size_t warnings = 0;
  std::size_t infos = 0;
};

Counts count(const std::vector<FileFindings>& files);

/// Sorts by place, then by rule: the order of output.
void sort_by_place(std::vector<Diagnostic>& diagnostics);

} // namespace orb
