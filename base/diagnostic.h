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

/// `info`, `warning` or `error`: the words of the text and JSON forms.
std::string_view to_string(Severity severity);

/// What is wrong with a line, as far as it matters to who looks for the line that was meant
/// (repair/), whatever the language.
enum class Trouble : std::uint8_t {
  Other,
  Unreadable,         ///< no statement that the language has
  MalformedLine,      ///< a statement whose parts are wrong
  UnknownName,        ///< a word that nothing defines
  ForeignWord,        ///< a word of another language
  ReservedName,       ///< a name that the language has taken
  WrongValue,         ///< a value of another kind than is needed
  ArgumentCount,      ///< too many values, or too few
  MisplacedStatement, ///< a statement that has nothing to leave
  UnclosedBlock,      ///< a block without its end
  BlockEnd,           ///< an end without its block
  Pattern,            ///< within a text, which is in another language
};

/// What a linter knows about one kind of finding. Rules live in tables beside the code that raises
/// them; `orb explain`, SARIF and docs/reference/rules.md are printed from the same rows.
struct Rule {
  std::string_view id; ///< kebab-case, unique over all tables
  Severity severity = Severity::Error;
  std::string_view summary;     ///< one sentence
  std::string_view explanation; ///< why it matters and what to do instead
  std::string_view bad;         ///< a smallest source that raises the rule
  std::string_view good;        ///< the same, corrected
  std::uint8_t robot_error = 0; ///< the error number that the robot would report, 0 for none
  Trouble trouble = Trouble::Other;
};

/// A row as a program carries it. Where ORB_BRIEF_RULES is defined it is without what only explains
/// the rule, for a program that every visitor of a page loads.
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

/// Safe edits keep the meaning of a program that works; unsafe ones want a look.
enum class Safety : std::uint8_t { Safe, Unsafe };

struct Fix {
  Message title;
  std::vector<Edit> edits; ///< ascending, not overlapping
  Safety safety = Safety::Safe;
};

/// A line that was checked as the line to write.
struct Considered {
  enum class Verdict : std::uint8_t {
    Worse,  ///< the line, or others, would have errors
    Parses, ///< as many errors remain as before
    Mends,  ///< fewer errors remain
  };
  std::string line;
  std::string_view origin; ///< the step that proposed it
  int cost = 0;            ///< the cheapest comes first
  Verdict verdict = Verdict::Worse;
};

struct Note {
  Span span;
  Message message;
};

/// One finding about the user's input. Plain data: renderers print it, policy weighs it.
struct Diagnostic {
  const Rule* rule = nullptr;
  Severity severity = Severity::Error; ///< the rule's, unless the policy changed it
  Span span;
  Message message; ///< what was seen: lower case, no full stop, code in backticks
  Message help;    ///< what helps; may be empty
  std::vector<Note> notes;
  std::optional<Fix> fix;
  std::vector<Considered> considered;      ///< what was tried for the line to write, in order
  std::optional<std::uint32_t> basic_line; ///< the orbBasic line number, where there is one
};

/// A finding of `rule` at `span`, with the rule's severity.
Diagnostic finding(const Rule& rule, Span span, Message message, Message help = {});

inline bool is_error(const Diagnostic& diagnostic) {
  return diagnostic.severity == Severity::Error;
}
bool any_error(const std::vector<Diagnostic>& findings);

/// Whether there is no program with such a finding. A warning that became an error, as it comes
/// true for certain, is of a program that can be run to see how it stops.
inline bool keeps_from_building(const Diagnostic& diagnostic) {
  return is_error(diagnostic) && diagnostic.rule->severity == Severity::Error;
}

/// The findings of one file, as the renderers take them.
struct FileFindings {
  const Source* source = nullptr;
  std::vector<Diagnostic> diagnostics;
  std::optional<std::size_t> built_size; ///< bytes of the image, where one could be built
};

struct Counts {
  std::size_t errors = 0;
  std::size_t warnings = 0;
  std::size_t infos = 0;
};

Counts count(const std::vector<FileFindings>& files);

/// Orders by place, then by rule: the order in which findings are printed.
void sort_by_place(std::vector<Diagnostic>& diagnostics);

} // namespace orb
